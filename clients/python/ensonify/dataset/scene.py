"""Pictures of one scene from its record."""
import math
from pathlib import Path

import numpy as np

from ensonify import Record, labels
from ensonify.labels import pictures
from ensonify.labels.__main__ import record_of
from ensonify.messages import BottomTrack, Ping
from ensonify.session import EXIT_BAD_INPUT, RunError


def pictures_of(recipe: dict, scene: dict, out: Path) -> list:
    """Pictures of a scene, in the order of its samples."""
    display = pictures.Display(recipe["white_db"], recipe["range_db"])
    with Record(record_of(str(out))) as record:
        topic = topic_of(record, recipe["head"])
        make = chips if recipe["chip"] else whole_pings
        made = make(record, topic, recipe, scene, display)
    for picture, sample in zip(made, scene["samples"]):
        picture.name = f"{sample['number']:08d}" + (f"_{scene['pair']}" if scene["pair"] else "")
        keep_labelled(picture, scene, recipe["least_pixels"])
    return made


def topic_of(record: Record, head: str) -> str:
    topics = [topic for topic in labels.ping_topics(record) if topic.startswith(f"{head}/")]
    if len(topics) != 1:
        found = ", ".join(topics) or "none"
        raise RunError(f"{record.file}: labelled topics of {head}: {found}; allowed is one, with its labels recorded", EXIT_BAD_INPUT)
    return topics[0]


def whole_pings(record: Record, topic: str, recipe: dict, scene: dict, display) -> list:
    wanted = [recipe["first"] + recipe["every"] * i for i in range(len(scene["samples"]))]
    response = recipe["mask"] == "response"
    pairs = [pair for number, pair in enumerate(labels.labelled(record, topic, response)) if number in set(wanted)]
    if len(pairs) < len(wanted):
        raise RunError(f"{record.file}: has too few pings for {len(wanted)} pictures; let the launch run longer", EXIT_BAD_INPUT)
    return [pictures.of_ping(pair, recipe["view"], display, {"topic": topic, **pose_of(pair.ping)}, response)
            for pair in pairs]


def chips(record: Record, topic: str, recipe: dict, scene: dict, display) -> list:
    """Parts of the waterfall about the places of the samples, shifted as drawn."""
    pairs = list(labels.labelled(record, topic))
    beside = topic.replace("/ping", "/bottom")
    altitudes = {track.ping: track.altitude_m for _, _, track in record.messages(beside) if isinstance(track, BottomTrack) and track.valid}
    if not pairs or not altitudes:
        raise RunError(f"{record.file}: a chip needs pings and {beside}; let the launch record both", EXIT_BAD_INPUT)
    width, height, jitter = (recipe["chip"][key] for key in ("width", "height", "jitter"))
    columns = 2 * pairs[0].labels.samples
    if len(pairs) < height or columns < width:
        raise RunError(f"{record.file}: the waterfall has {columns} columns and {len(pairs)} lines; a chip has {width} and {height}",
                       EXIT_BAD_INPUT)
    track = np.array([pair.ping.pose_position_enu_m[0] for pair in pairs])
    ahead = np.array([forward(pair.ping) for pair in pairs])
    made = []
    for sample in scene["samples"]:
        line, column = place_in(pairs, track, ahead, altitudes, sample["place"])
        left = column - width // 2 + int(round(sample["shift"][0] * jitter * width))
        top = line - height // 2 + int(round(sample["shift"][1] * jitter * height))
        left, top = min(max(left, 0), columns - width), min(max(top, 0), len(pairs) - height)
        held = pairs[top:top + height]
        facts = {"topic": topic, "left": left, "top": top, **pose_of(held[height // 2].ping)}
        made.append(pictures.of_waterfall(held, left, width, display, facts))
    return made


def place_in(pairs: list, track: np.ndarray, ahead: np.ndarray, altitudes: dict, place: list) -> tuple:
    """Line and column of the waterfall at which a place of the ground is abeam."""
    off = np.array(place) - track[:, :2]
    line = int(np.argmin(np.abs((off * ahead).sum(1))))
    ping: Ping = pairs[line].ping
    nearest = min(altitudes, key=lambda number: abs(number - ping.ping))
    to_starboard = off[line] @ np.array([ahead[line][1], -ahead[line][0]])
    slant_m = math.hypot(to_starboard, altitudes[nearest])
    sample = int(round((2 * slant_m / ping.sound_speed_mps - ping.first_sample_s) / ping.sample_period_s))
    samples = pairs[line].labels.samples
    return line, samples + sample if to_starboard > 0 else samples - 1 - sample


def forward(ping: Ping) -> np.ndarray:
    """Heading of a head as a unit vector, east and north."""
    w, x, y, z = ping.pose_enu_from_head[0]
    level = np.array([1 - 2 * (y * y + z * z), 2 * (x * y + w * z)])
    return level / np.linalg.norm(level)


def pose_of(ping: Ping) -> dict:
    """Where the head is, as it knows."""
    east, north = forward(ping)
    return {"head_enu_m": [float(x) for x in ping.pose_position_enu_m[0]], "heading_deg": math.degrees(math.atan2(east, north)) % 360}


def keep_labelled(picture: pictures.Picture, scene: dict, least_pixels: int) -> None:
    """Leaves the recipe's objects of enough pixels in the labels. What else there is stands in the facts."""
    wanted = {thing["name"] for thing in scene["things"] if thing["labelled"]}
    kept, others = [], []
    for thing in picture.things:
        pixels = int(thing.mask.sum())
        if thing.name in wanted and pixels >= least_pixels:
            kept.append(thing)
        else:
            others.append({"name": thing.name, "class": thing.class_name, "pixels": pixels})
    picture.things = kept
    picture.layer[~np.isin(picture.layer, [thing.instance for thing in kept])] = 0
    picture.facts["not_labelled"] = others
