"""Labelled pictures that are rendered while they are read: a scene of another seed each, so that no epoch repeats one."""
import hashlib
import subprocess
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any, Callable, Iterator, Mapping, Sequence

import numpy as np

from ensonify import Record
from ensonify.labels import outlines, pictures
from ensonify.labels.dataset import Sample
from ensonify.launching import assignments, program
from ensonify.session import EXIT_BAD_INPUT, RunError

try:
    from torch.utils.data import IterableDataset, get_worker_info
except ImportError:  # it is of use without torch
    IterableDataset, get_worker_info = object, lambda: None

EXPECTATION_FAILED = 1  # of a launch's own expectations, which another scene need not fulfil
DONE = (0, EXPECTATION_FAILED)


class Live(IterableDataset):
    """An iterable-style data set, as torch.utils.data.DataLoader takes it; it needs no torch.

        loader = DataLoader(Live("launch/object_training.yaml", "side/ping_main", ["clutter", "mine-like"], scenes=50),
                            batch_size=8, num_workers=1, collate_fn=list)

    launch: a launch file that records the pings of `topic` and their labels
    names: classes; others than these are refused
    scenes: runs of an epoch, each with a seed of its own; loader workers share them
    seed: of the seeds; another one gives other scenes. Workers of a DataLoader draw theirs from torch.manual_seed
    args, set: arguments and parameters of every run, as `--arg` and `--set`
    view, lines: as ensonify.labels.pictures.pictures
    transform: from a Sample to an item

    While one scene is read, the next is rendered. Raises RunError for a launch that cannot be run."""

    def __init__(self, launch: str | Path, topic: str, names: Sequence[str], *, scenes: int, seed: int = 0,
                 args: Mapping[str, Any] | None = None, set: Mapping[str, Any] | None = None, view: str = "polar", lines: int = 256, transform: Callable | None = None):
        if scenes < 1:
            raise ValueError(f"scenes is {scenes}; allowed is 1 or more")
        self.launch, self.topic, self.names = Path(launch), topic, list(names)
        self._scenes, self._seed, self._args, self._set = scenes, seed, dict(args or {}), dict(set or {})
        self._view, self._lines, self._transform = view, lines, transform
        self._epoch = 0

    def __iter__(self) -> Iterator:
        worker = get_worker_info()
        seeds = self._seeds(worker)
        with ThreadPoolExecutor(1) as ahead:
            coming = ahead.submit(self._render, seeds[0]) if seeds else None
            for number in range(len(seeds)):
                samples = coming.result()
                coming = ahead.submit(self._render, seeds[number + 1]) if number + 1 < len(seeds) else None
                for sample in samples:
                    yield self._transform(sample) if self._transform else sample

    def _seeds(self, worker: Any) -> list:
        """Of the scenes of this epoch that are ours. A worker's own seed changes from epoch to epoch."""
        number, workers, base = (worker.id, worker.num_workers, worker.seed) if worker else (0, 1, self._epoch)
        self._epoch += 1
        return [seed_of(self._seed, base, scene) for scene in range(number, self._scenes, workers)]

    def _render(self, seed: int) -> list:
        """Samples of a scene."""
        with tempfile.TemporaryDirectory(prefix="ensonify-live-") as out:
            words = [program(), "run", str(self.launch), "--free", "--quiet", "--out", out]
            for option, settings in (("--arg", self._args), ("--set", {**self._set, "seed": seed})):
                words += [word for assignment in assignments(settings) for word in (option, assignment)]
            run = subprocess.run(words, capture_output=True, text=True, stdin=subprocess.DEVNULL)
            if run.returncode not in DONE:
                raise RunError(f"{self.launch}, seed {seed}: exit code {run.returncode}: {run.stderr.strip()}", run.returncode)
            files = sorted(Path(out).glob("*.mcap"))
            if len(files) != 1:
                raise RunError(f"{self.launch}: writes {len(files)} records; allowed is one", EXIT_BAD_INPUT)
            with Record(files[0]) as record:
                return [self._sample(picture, seed)
                        for picture in pictures.pictures(record, self.topic, view=self._view, lines=self._lines)]

    def _sample(self, picture: pictures.Picture, seed: int) -> Sample:
        boxes, classes = [], []
        for thing in picture.things:
            if (box := outlines.box(thing.mask)) is None:
                continue
            if thing.class_name not in self.names:
                raise RunError(f"{self.launch}: class {thing.class_name!r}; names has {', '.join(self.names)}", EXIT_BAD_INPUT)
            x, y, wide, high = box
            boxes.append([x, y, x + wide, y + high])
            classes.append(self.names.index(thing.class_name))
        return Sample(picture.grey, np.array(boxes, np.float32).reshape(-1, 4), np.array(classes, np.int64), f"{seed}_{picture.name}")


def seed_of(*numbers: int) -> int:
    """A seed that differs with each of these numbers, 0..2^53 - 1."""
    digest = hashlib.sha256(" ".join(map(str, numbers)).encode()).digest()
    return int.from_bytes(digest[:8], "little") >> 11
