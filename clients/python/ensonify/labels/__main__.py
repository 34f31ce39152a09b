"""python -m ensonify.labels RECORD -o DIR --format coco: labelled pictures of a record as files."""
import argparse
import json
import sys
from pathlib import Path

from ensonify import Record, labels
from ensonify.session import EXIT_BAD_INPUT, RunError


def parser() -> argparse.ArgumentParser:
    of = argparse.ArgumentParser(prog="python -m ensonify.labels", description="Labelled pictures of a record as files.")
    of.add_argument("record", help="a record, or the folder of a run")
    of.add_argument("-o", "--out", required=True, help="folder to write; it must be empty or not be there")
    of.add_argument("--format", nargs="+", default=["coco"], choices=["masks", "coco", "yolo", "voc", "webdataset"],
                    help="one or several of masks, coco, yolo, voc, webdataset (default: coco)")
    of.add_argument("--yolo", default="detect", choices=["detect", "segment", "oriented"], help="form of yolo's lines")
    of.add_argument("--box", default="object", choices=["object", "object+shadow", "shadow"], help="what a box goes round")
    of.add_argument("--mask", default="geometry", choices=["geometry", "response"],
                    help="cells that an object covers, or samples of which it sends at least half (needs `labels: energies`)")
    of.add_argument("--topic", nargs="*", help="topics of pings; all that are labelled if left out")
    of.add_argument("--view", default="polar", choices=["polar", "cartesian"], help="of imaging heads: sample by beam, or a fan")
    of.add_argument("--lines", type=int, default=256, help="lines of a sidescan in a picture (default: 256)")
    of.add_argument("--every", type=int, default=1, help="every so many pictures only")
    of.add_argument("--white-db", type=float, default=-30.0, help="level of white behind the gain, over the source level")
    of.add_argument("--range-db", type=float, default=55.0, help="decibels from black to white")
    return of


def record_of(name: str) -> Path:
    """The record itself, or the one in a run's folder."""
    path = Path(name)
    if not path.is_dir():
        return path
    found = sorted(path.glob("*.mcap"))
    if len(found) != 1:
        raise RunError(f"{name}: has {len(found)} records; allowed is a folder with one, or a record itself", EXIT_BAD_INPUT)
    return found[0]


def export(args: argparse.Namespace) -> dict:
    """Writes and returns counts: pictures, and by class."""
    from ensonify.labels import formats, pictures

    folder = Path(args.out)
    if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        raise RunError(f"{folder}: is not empty; allowed is a folder that is empty or not there", EXIT_BAD_INPUT)
    for name, least in (("--lines", args.lines), ("--every", args.every)):
        if least < 1:
            raise RunError(f"{name}: {least}; allowed is 1 or more", EXIT_BAD_INPUT)
    if not args.range_db > 0:
        raise RunError(f"--range-db: {args.range_db:g}; allowed is above 0", EXIT_BAD_INPUT)
    counts: dict = {}
    total = 0
    with Record(record_of(args.record)) as record:
        topics = args.topic or labels.ping_topics(record)
        if not topics:
            raise RunError(f"{record.file}: has no labels; a head makes them with `labels: masks`", EXIT_BAD_INPUT)
        writers: list = [] if args.format == ["webdataset"] else [formats.Images(folder)]
        for name in args.format:
            form = {"form": args.yolo} if name == "yolo" else {}
            writers.append(formats.WRITERS[name](folder, args.box, **form))
        display = pictures.Display(args.white_db, args.range_db)
        for topic in topics:
            shown = pictures.pictures(record, topic, view=args.view, lines=args.lines, display=display, mask=args.mask)
            for number, picture in enumerate(shown):
                if number % args.every:
                    continue
                total += 1
                for thing in picture.things:
                    counts[thing.class_name] = counts.get(thing.class_name, 0) + 1
                for writer in writers:
                    writer.add(picture)
        for writer in writers:
            writer.close()
    return {"pictures": total, "objects": dict(sorted(counts.items()))}


def main(arguments: list | None = None) -> int:
    args = parser().parse_args(arguments)
    try:
        print(json.dumps(export(args)))
    except RunError as error:
        print(f"ensonify.labels: {error}", file=sys.stderr)
        return error.code
    except ModuleNotFoundError as error:
        if error.name != "PIL":
            raise
        print("ensonify.labels: needs Pillow: pip install 'ensonify[labels]'", file=sys.stderr)
        return EXIT_BAD_INPUT
    except OSError as error:
        print(f"ensonify.labels: {error.filename or args.out}: {error.strerror}", file=sys.stderr)
        return 5
    return 0


if __name__ == "__main__":
    sys.exit(main())
