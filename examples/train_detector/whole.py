"""The class of a whole cut-out: a net, its training, and its answers. The way down is the detector's; its class is said by the mean and
the highest of its features over the picture, since nothing tells where in a cut-out the thing is."""
from pathlib import Path

import numpy as np
import torch
from PIL import Image
from torch import nn

from net import Net, seen

BATCH, FASTEST = 32, 2e-3  # pictures of a step; rate of learning


class Whole(nn.Module):
    """forward(pictures: n x 2 x size x size, as `net.seen` gives them) gives log odds of each class."""

    def __init__(self, classes: int):
        super().__init__()
        way = Net(classes)
        self.stem, self.down = way.stem, way.down
        self.kind = nn.Linear(2 * way.side[-1].in_channels, classes)

    def forward(self, pictures):
        x = self.stem(pictures)
        for down in self.down:
            x = down(x)
        return self.kind(torch.cat([x.mean((2, 3)), x.amax((2, 3))], 1))


class Real:
    """Cut-outs of labelled pictures, by class; each is a whole picture."""

    def __init__(self, pictures: list):
        self.of_class: dict = {}
        for picture in pictures:
            for thing in (one for one in picture.things if not one.ignored):
                self.of_class.setdefault(thing.name, []).append(picture)
        self.held: dict = {}

    def draw(self, name: str, random: np.random.Generator) -> np.ndarray:
        picture = self.of_class[name][int(random.integers(len(self.of_class[name])))]
        if id(picture) not in self.held:
            self.held[id(picture)] = picture.grey()
        return self.held[id(picture)]


def framed(grey: np.ndarray, size: int, random: np.random.Generator | None = None) -> np.ndarray:
    """A cut-out of any size in a square of 0..1, its longer side over all; black beyond it. With `random` a little larger or smaller,
    shifted, mirrored, and with another gain and curve: of real and generated ones alike."""
    longer, shift = max(grey.shape), np.zeros(2)
    if random is not None:
        longer, shift = longer * random.uniform(0.8, 1.1), random.uniform(-0.06, 0.06, 2) * longer
    step = longer / size
    top, left = 0.5 * np.array(grey.shape) - 0.5 * longer + shift
    picture = Image.fromarray(grey)
    if step > 1:
        picture = picture.resize([max(1, round(side / step)) for side in picture.size], Image.BOX)
        top, left, step = top / step, left / step, 1.0
    level = np.asarray(picture.transform((size, size), Image.AFFINE, (step, 0, left, 0, step, top), Image.BILINEAR), np.float32) / 255
    if random is None:
        return level
    level = (level ** random.uniform(0.7, 1.4) * random.uniform(0.7, 1.2)).clip(0, 1)
    return np.ascontiguousarray(level[:, ::-1] if random.random() < 0.5 else level)


def batch(sources: list, names: list, size: int, random: np.random.Generator) -> tuple:
    """(pictures, classes) of a step: each source and each of its classes as often as another."""
    pictures, kinds = [], []
    for _ in range(BATCH):
        source = sources[int(random.integers(len(sources)))]
        name = str(random.choice(sorted(source.of_class)))
        pictures.append(framed(source.draw(name, random), size, random))
        kinds.append(names.index(name))
    return seen(torch.from_numpy(np.stack(pictures))), torch.tensor(kinds)


def train(sources: list, names: list, file: Path, steps: int, size: int, seed: int, jobs: int = 2) -> Whole:
    """A net after so many steps. `file` keeps it: what is there already is not trained again."""
    torch.set_num_threads(max(1, jobs - 1))  # one processor is left to whoever else works
    torch.manual_seed(seed)
    net = Whole(len(names))
    if file.is_file():
        net.load_state_dict(torch.load(file, map_location="cpu"))
        return net.eval()
    optimiser = torch.optim.AdamW(net.parameters(), FASTEST, weight_decay=1e-3)
    net.train()
    for step in range(steps):
        x, kinds = batch(sources, names, size, np.random.default_rng([seed, step]))
        for group in optimiser.param_groups:
            group["lr"] = FASTEST * min(1, (step + 1) / 20) * 0.5 * (1 + np.cos(np.pi * step / steps))
        loss = nn.functional.cross_entropy(net(x), kinds, label_smoothing=0.1)
        optimiser.zero_grad()
        loss.backward()
        optimiser.step()
    partial = file.with_suffix(".part")
    torch.save(net.state_dict(), partial)
    partial.replace(file)
    return net.eval()


def said(net: Whole, pictures: list, size: int, asked: list) -> np.ndarray:
    """The class of each labelled picture, of those asked for: of the mean over it and its mirrored one."""
    odds = []
    with torch.no_grad():
        for first in range(0, len(pictures), 256):
            x = seen(torch.from_numpy(np.stack([framed(picture.grey(), size) for picture in pictures[first:first + 256]])))
            odds.append(torch.log_softmax(net(x), 1) + torch.log_softmax(net(x.flip(-1)), 1))
    return np.array(asked)[torch.cat(odds)[:, asked].argmax(1).numpy()]
