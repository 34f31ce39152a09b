"""A detector against labels: what is in each picture beside what it finds there."""
import json
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw

import scores
from detector import Detector, Found
from groups import groups_of
from labelled import Labelled


def judged(picture: Labelled, found: Found, names: list, shape: tuple, mask_iou: list, threshold: float) -> scores.Judged:
    """mask_iou: gets the overlap of each labelled mask with the best find over the threshold; 0 where there is none."""
    things = [thing for thing in picture.things if thing.box is not None]
    for thing in things:
        mask = None if thing.ignored else thing.mask(shape)
        if mask is not None and mask.any():
            sure = [of for of, score in zip(found.masks, found.scores) if score >= threshold]
            mask_iou.append(max(((mask & of).sum() / (mask | of).sum() for of in sure), default=0.0))
    return scores.Judged(np.array([thing.box for thing in things], float).reshape(-1, 4),
                         np.array([names.index(thing.name) if thing.name in names else -1 for thing in things], int),
                         np.array([thing.ignored for thing in things], bool), found.boxes, found.scores, found.kinds, shape[0] * shape[1])


def against_boxes(detector: Detector, pictures: list, draw: Path | None = None) -> dict:
    """Scores of pictures whose things have boxes, each with an interval."""
    of, mask_iou = [], []
    for picture in pictures:
        grey = picture.grey()
        found = detector.find(grey)
        of.append(judged(picture, found, detector.names, grey.shape, mask_iou, detector.threshold))
        if draw is not None:
            drawn(grey, picture, found, detector).save(draw / f"{picture.file.stem}.png")
    asked = sorted({kind for one in of for kind in one.kinds if kind >= 0})
    groups = groups_of(pictures)
    result = {"pictures": len(of), "groups": int(groups.max() + 1), "things": sum(int((~one.ignored).sum()) for one in of),
              "classes": [detector.names[kind] for kind in asked], "threshold": detector.threshold}

    def score(some: list) -> dict:
        return scores.of_boxes(some, asked, detector.threshold)

    values, between = score(of), scores.interval(score, of, groups)
    result["scores"] = {name: {"value": value, "interval": between[name]} for name, value in values.items()}
    result["AP50 by class"] = {detector.names[kind]: scores.average_precision(of, 0.5, kind) for kind in asked}
    if mask_iou:
        result["mask IoU"] = float(np.mean(mask_iou))
    result.update(whole_pictures(detector, pictures, of, groups))
    return result


def whole_pictures(detector: Detector, pictures: list, found: list, groups: np.ndarray) -> dict:
    """The class of pictures that have one alone: that of the surest find. {} where fewer than two classes occur."""
    kinds = [{thing.name for thing in picture.things if not thing.ignored} for picture in pictures]
    pairs = [(detector.names.index(next(iter(kind))), said_kind(one), group) for kind, one, group in zip(kinds, found, groups)
             if len(kind) == 1 and next(iter(kind)) in detector.names]
    if len({truth for truth, *_ in pairs}) < 2:
        return {}

    def score(some: list) -> dict:
        truth, said = np.array(some)[:, 0], np.array(some)[:, 1]
        return scores.of_classes(truth, said, len(detector.names))

    between = scores.interval(score, [pair[:2] for pair in pairs], np.array([group for *_, group in pairs]))
    return {"class of the picture": {name: {"value": value, "interval": between[name]} for name, value in score([pair[:2] for pair in pairs]).items()}}


def said_kind(found) -> int:
    """Class whose score is highest in a picture; -1: nothing was found."""
    shares = found.kinds if isinstance(found, Found) else found.shares
    return int((found.scores[:, None] * shares).max(0).argmax()) if len(found.scores) else -1


def against_classes(detector: Detector, pictures: list) -> dict:
    """Scores of a folder for each class: no boxes are known."""
    found = [detector.find(picture.grey(), least_score=1e-4) for picture in pictures]
    result = {"pictures": len(pictures), **whole_pictures(detector, pictures, found, groups_of(pictures))}
    empty = [one for one, picture in zip(found, pictures) if not picture.things]
    if empty:
        result["empty_with_alarm"] = float(np.mean([(one.scores >= detector.threshold).any() for one in empty]))
    return result


def drawn(grey: np.ndarray, picture: Labelled, found: Found, detector: Detector) -> Image.Image:
    """A picture with its labels (blue) and what is found over the threshold (orange)."""
    image = Image.fromarray(grey).convert("RGB")
    pen = ImageDraw.Draw(image)
    for thing in picture.things:
        if thing.box is not None:
            pen.rectangle([float(edge) for edge in thing.box], outline=(80, 160, 255))
    for box, score, kind in zip(found.boxes, found.scores, found.kinds):
        if score >= detector.threshold:
            pen.rectangle([float(edge) for edge in box], outline=(255, 150, 0))
            pen.text((box[0] + 1, max(box[1] - 11, 0)), f"{detector.names[int(kind.argmax())]} {score:.2f}", fill=(255, 210, 0))
    return image


def as_text(result: dict) -> str:
    lines = [f"{result['pictures']} pictures" + (f", {result['groups']} groups, {result['things']} things of {', '.join(result['classes'])}; "
                                                 f"threshold {result['threshold']:.2f}" if "classes" in result else "")]
    for part in ("scores", "class of the picture"):
        for name, of in result.get(part, {}).items():
            between = of["interval"]
            lines.append(f"  {name:<34} {of['value']:.3f}" + (f"  ({between[0]:.3f} to {between[1]:.3f})" if between else ""))
    for name, value in result.get("AP50 by class", {}).items():
        lines.append(f"  AP50 of {name:<26} {value:.3f}")
    for name in ("mask IoU", "empty_with_alarm"):
        if name in result:
            lines.append(f"  {name:<34} {result[name]:.3f}")
    return "\n".join(lines)


def as_json(result: dict) -> str:
    """NaN, of what cannot be said, as null."""
    def plain(value):
        if isinstance(value, dict):
            return {key: plain(one) for key, one in value.items()}
        if isinstance(value, (list, tuple)):
            return [plain(one) for one in value]
        return None if isinstance(value, float) and np.isnan(value) else value
    return json.dumps(plain(result), indent=1)
