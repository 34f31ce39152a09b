"""Labels of pings: which sample of an image belongs to which object, and which lies in its shadow.

A head with `labels: masks` publishes labels/1 beside each ping, one with `labels: energies` also energies/1
(ensonify.labels.energies). Here they become arrays; `python -m ensonify.labels` writes
them as COCO, YOLO, Pascal VOC, PNG masks or WebDataset shards.
"""
from typing import Iterator, NamedTuple

import numpy as np

from ensonify.labels import energies as energies_of
from ensonify.messages import Energies, Labels, Ping
from ensonify.session import EXIT_BAD_INPUT, RunError

SEABED = -1  # whose shadow it is, of the seabed's own


class Labelled(NamedTuple):
    """A ping and its labels; its energies where they were asked for."""

    ping: Ping
    labels: Labels
    energies: Energies | None = None


def labels_topic(ping_topic: str) -> str:
    """Topic of the labels beside a ping's: eye/labels of eye/ping, side/labels_main of side/ping_main."""
    process, _, port = ping_topic.partition("/")
    return f"{process}/labels{port.removeprefix('ping')}"


def ping_topics(record) -> list:
    """Topics of pings that have labels beside them, in the order of the launch file."""
    topics = record.topics()
    return [topic for topic in record.topics_of(Ping) if labels_topic(topic) in topics]


def labelled(record, topic: str, energies: bool = False) -> Iterator[Labelled]:
    """Pings of a topic with their labels, in their order, and with their energies if these are asked for. Raises RunError where
    the record has none for it."""
    beside, sent = labels_topic(topic), energies_of.topic_of(topic)
    if beside not in record.topics():
        known = ", ".join(ping_topics(record)) or "none: a head makes labels with `labels: masks`"
        raise RunError(f"{record.file}: has no {beside}; labelled are {known}", EXIT_BAD_INPUT)
    if energies and sent not in record.topics():
        raise RunError(f"{record.file}: has no {sent}; a head makes it with `labels: energies`", EXIT_BAD_INPUT)
    waiting: dict = {}  # by ping number, then by type
    for message in record.messages(topic, beside, *([sent] if energies else [])):
        content = message.content
        parts = waiting.setdefault(content.ping, {})
        parts[type(content)] = content
        if len(parts) < (3 if energies else 2):
            continue
        waiting.clear()  # all come in order: what waits has lost a part
        check(parts[Labels], beside)
        if energies:
            energies_of.check(parts[Energies], sent)
        yield Labelled(parts[Ping], parts[Labels], parts.get(Energies))


def check(labels: Labels, topic: str) -> None:
    """Raises RunError for runs that do not lie in the image or belong to no object."""
    for runs, least in ((labels.mask_run, 0), (labels.layer_run, 0), (labels.shadow_run, SEABED)):
        if runs.size == 0:
            continue
        if runs.ndim != 2 or runs.shape[1] != 4:
            raise RunError(f"{topic}: ping {labels.ping}: runs of shape {runs.shape}; allowed is (runs, 4)", EXIT_BAD_INPUT)
        whose, beam, first, end = runs.T
        if (whose.min() < least or whose.max() >= len(labels.objects) or beam.min() < 0 or beam.max() >= labels.beams
                or first.min() < 0 or end.max() > labels.samples or (end <= first).any()):
            raise RunError(f"{topic}: ping {labels.ping}: runs lie outside the image of {labels.beams} x {labels.samples} or name no object", EXIT_BAD_INPUT)
    shadowed = int((labels.shadow_run[:, 3] - labels.shadow_run[:, 2]).sum()) if labels.shadow_run.size else 0
    if labels.shadow_db.size != shadowed:
        raise RunError(f"{topic}: ping {labels.ping}: shadow_db does not fit its runs", EXIT_BAD_INPUT)


def _fill(runs: np.ndarray, wanted: int, into: np.ndarray) -> np.ndarray:
    for whose, beam, first, end in runs:
        if whose == wanted:
            into[beam, first:end] = True
    return into


def mask(labels: Labels, place: int) -> np.ndarray:
    """Own mask of an object, by its place in labels.objects: beams x samples, bool. Masks of two objects may overlap."""
    return _fill(labels.mask_run, place, np.zeros((labels.beams, labels.samples), bool))


def shadow(labels: Labels, place: int) -> np.ndarray:
    """Shadow of an object by its place in labels.objects, or of the seabed itself (SEABED): beams x samples, bool."""
    return _fill(labels.shadow_run, place, np.zeros((labels.beams, labels.samples), bool))


def shadow_db(labels: Labels) -> np.ndarray:
    """Depth of all shadows in dB, 0 where there is none: beams x samples, uint8."""
    depth, at = np.zeros((labels.beams, labels.samples), np.uint8), 0
    for _, beam, first, end in labels.shadow_run:
        depth[beam, first:end] = labels.shadow_db[at:at + end - first]
        at += end - first
    return depth


def layer(labels: Labels) -> np.ndarray:
    """One mask of all: the instance that sends most in each cell, 0 where there is none: beams x samples, int32."""
    cells = np.zeros((labels.beams, labels.samples), np.int32)
    for place, beam, first, end in labels.layer_run:
        cells[beam, first:end] = labels.objects[place].instance
    return cells
