// Shaded relief with contours under the cells, and latitude and longitude of places: made of what the gateway sends.
import proj4 from "proj4";
import { ConsoleRelief } from "./messages";
import { IN_MEMORY } from "./palette";

const DEEP = [34, 62, 84]; // colour of the relief where the light falls straight on it
const CONTOUR = "rgba(190, 215, 235, 0.45)";

/** 54° 12.3456' N. */
function angleText(degrees: number, positive: string, negative: string, digits: number): string {
  const tenThousandths = Math.round(Math.abs(degrees) * 60e4);
  const whole = Math.floor(tenThousandths / 60e4);
  const minutes = ((tenThousandths - whole * 60e4) / 1e4).toFixed(4).padStart(7, "0");
  return `${String(whole).padStart(digits, "0")}° ${minutes}' ${degrees < 0 ? negative : positive}`;
}

export class Relief {
  private relief: ConsoleRelief;
  private posts = document.createElement("canvas"); // a pixel a post, north up
  private plane: proj4.Converter;

  constructor(relief: ConsoleRelief) {
    this.relief = relief;
    this.plane = proj4(relief.projection);
    const [rows, columns] = relief.shade.shape.length === 2 ? relief.shade.shape : [0, 0];
    if (!rows || !columns) return;
    this.posts.width = columns;
    this.posts.height = rows;
    const context = this.posts.getContext("2d", IN_MEMORY)!;
    const image = context.createImageData(columns, rows);
    for (let row = 0; row < rows; ++row) {
      for (let column = 0; column < columns; ++column) {
        const shade = relief.shade.data[row * columns + column];
        const at = 4 * ((rows - 1 - row) * columns + column);
        for (let c = 0; c < 3; ++c) image.data[at + c] = (DEEP[c] * shade) / 180;
        image.data[at + 3] = shade ? 255 : 0;
      }
    }
    context.putImageData(image, 0, 0);
  }

  get contourStep_m(): number {
    return this.relief.contour_depth_m.data.length ? this.relief.contour_step_m : 0;
  }

  get extent(): [number, number, number, number] | null {
    const { west_m, south_m, spacing_m, shade } = this.relief;
    if (shade.shape.length !== 2 || !shade.shape[0]) return null;
    return [west_m, south_m, west_m + (shade.shape[1] - 1) * spacing_m, south_m + (shade.shape[0] - 1) * spacing_m];
  }

  /** Latitude and longitude of a place of the plane, WGS 84. */
  degreesOf(east_m: number, north_m: number): [number, number] {
    const [longitude, latitude] = this.plane.inverse([east_m, north_m]);
    return [latitude, longitude];
  }

  textOf(east_m: number, north_m: number): string {
    const [latitude, longitude] = this.degreesOf(east_m, north_m);
    return `${angleText(latitude, "N", "S", 2)}, ${angleText(longitude, "E", "W", 3)}`;
  }

  /** A canvas of width x height pixels over an extent. */
  draw(canvas: HTMLCanvasElement, [west, , east, north]: number[], width: number, height: number) {
    canvas.width = width;
    canvas.height = height;
    const context = canvas.getContext("2d")!;
    const metre_px = width / (east - west);
    const covered = this.extent;
    if (!covered) return;
    const half_m = this.relief.spacing_m / 2; // a post's pixel lies about it
    const x = (east_m: number) => (east_m - west) * metre_px;
    const y = (north_m: number) => (north - north_m) * metre_px;
    context.drawImage(
      this.posts, x(covered[0] - half_m), y(covered[3] + half_m),
      (covered[2] - covered[0] + 2 * half_m) * metre_px, (covered[3] - covered[1] + 2 * half_m) * metre_px,
    );
    const pieces = this.relief.contour_m.data;
    context.strokeStyle = CONTOUR;
    context.beginPath();
    for (let i = 0; i + 3 < pieces.length; i += 4) {
      context.moveTo(x(pieces[i]), y(pieces[i + 1]));
      context.lineTo(x(pieces[i + 2]), y(pieces[i + 3]));
    }
    context.stroke();
  }

  /** Depth of the nearest contour within a distance; null: there is none. */
  contourAt(east_m: number, north_m: number, within_m: number): number | null {
    const pieces = this.relief.contour_m.data;
    let nearest = within_m;
    let depth: number | null = null;
    for (let i = 0; i < this.relief.contour_depth_m.data.length; ++i) {
      const [x0, y0, x1, y1] = [pieces[4 * i], pieces[4 * i + 1], pieces[4 * i + 2], pieces[4 * i + 3]];
      const squared = (x1 - x0) ** 2 + (y1 - y0) ** 2;
      const part = squared ? Math.max(0, Math.min(1, ((east_m - x0) * (x1 - x0) + (north_m - y0) * (y1 - y0)) / squared)) : 0;
      const distance = Math.hypot(east_m - x0 - part * (x1 - x0), north_m - y0 - part * (y1 - y0));
      if (distance >= nearest) continue;
      nearest = distance;
      depth = this.relief.contour_depth_m.data[i];
    }
    return depth;
  }
}
