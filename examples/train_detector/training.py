"""Training of a net on generated pictures, which can be interrupted."""
import multiprocessing
import time
from pathlib import Path

import numpy as np
import torch
from torch.nn import functional

from generated import Example
from net import STRIDE, Net, peaks, seen

SIZE, BATCH = 256, 16  # pixels of a training picture's sides; pictures of a step
FOURS = 0.5  # share of training pictures that are four small ones
AHEAD = 4  # batches that are drawn before they are wanted
FASTEST = 2e-3  # rate of learning
SHIFTED = 3  # boxes about each thing that the second look learns from
LOOKED_AT = 6  # boxes of the first look in each picture that it learns from
A_THING, NOTHING = 0.5, 0.4  # overlap with a thing from which, and below which, a box counts as it, and as nothing


def targets(examples: list) -> dict:
    """What the net should say of a batch, as tensors. Each thing has the weight of one, in as many cells as it has."""
    side, count = len(examples[0].owner) // STRIDE, len(examples)
    there = np.zeros((count, side, side), np.float32)
    counts = np.ones((count, side, side), np.float32)  # 0 where a thing does not count
    weight = np.zeros((count, side, side), np.float32)  # of the boxes there
    edges = np.zeros((count, 4, side, side), np.float32)
    pixels = np.zeros((count, side, side), np.float32)
    y, x = np.mgrid[0:side, 0:side]
    for i, example in enumerate(examples):
        cells = example.owner.reshape(side, STRIDE, side, STRIDE)
        pixels[i] = (cells > 0).mean((1, 3))
        counts[i][(cells < 0).any((1, 3))] = 0
        order = np.argsort([-(box[2] - box[0]) * (box[3] - box[1]) for box in example.boxes])
        for place in order:  # the small ones last
            left, top, right, bottom = example.boxes[place]
            row, column = ((top + bottom) / 2 / STRIDE, (left + right) / 2 / STRIDE)
            wide, high = max((right - left) / STRIDE, 1.0), max((bottom - top) / STRIDE, 1.0)
            far = ((x + 0.5 - column) / (0.22 * wide + 0.3)) ** 2 + ((y + 0.5 - row) / (0.22 * high + 0.3)) ** 2
            there[i] = np.maximum(there[i], np.exp(-0.5 * far))
            middle = (min(int(row), side - 1), min(int(column), side - 1))
            there[i][middle] = 1.0
            near = (np.abs(x - middle[1]) <= max(1, 0.25 * wide)) & (np.abs(y - middle[0]) <= max(1, 0.25 * high))  # the peak may be there
            near &= (np.abs(x + 0.5 - column) < 0.5 * wide) & (np.abs(y + 0.5 - row) < 0.5 * high)
            near[middle] = True
            weight[i][near] = 1 / near.sum()
            at_x, at_y = (x[near] + 0.5) * STRIDE, (y[near] + 0.5) * STRIDE
            edges[i][:, near] = [at_x - left, at_y - top, right - at_x, bottom - at_y]
    boxes = np.concatenate([np.insert(example.boxes, 0, i, axis=1) for i, example in enumerate(examples)]).astype(np.float32)
    kinds = np.concatenate([example.kinds for example in examples])
    return {name: torch.from_numpy(value) for name, value in
            dict(there=there, counts=counts, weight=weight, edges=edges.clip(0.5), pixels=pixels, boxes=boxes, kinds=kinds).items()}


def loss_of(net: Net, pictures: torch.Tensor, wanted: dict) -> torch.Tensor:
    """Focal loss of the middles, overlap of boxes, cross-entropy and overlap of pixels; of the second look, cross-entropy of what it
    says and overlap of its boxes."""
    there, edges, pixels, features = net(pictures)
    return first_loss(there[:, 0], edges, pixels[:, 0], wanted) + second_loss(net, there[:, 0], edges, features, wanted)


def first_loss(there: torch.Tensor, edges: torch.Tensor, pixels: torch.Tensor, wanted: dict) -> torch.Tensor:
    share, counts = torch.sigmoid(there), wanted["counts"]
    is_middle = wanted["there"] == 1
    hit = functional.softplus(-there) * (1 - share) ** 2
    miss = functional.softplus(there) * share ** 2 * (1 - wanted["there"]) ** 4
    loss = (torch.where(is_middle, hit, miss) * counts).sum() / is_middle.sum().clamp(min=1)
    known = wanted["weight"] > 0
    if known.any():
        weight = wanted["weight"][known]
        said, of = (corners(one.permute(0, 2, 3, 1)[known]) for one in (edges, wanted["edges"]))
        loss = loss + 2 * ((1 - overlap(said, of)) * weight).sum() / weight.sum()
    share, of = torch.sigmoid(pixels), wanted["pixels"]
    cross = functional.binary_cross_entropy_with_logits(pixels, of, reduction="none")
    dice = 1 - (2 * (share * of * counts).sum() + 1) / ((share * counts).sum() + (of * counts).sum() + 1)
    return loss + (cross * counts).mean() + 0.5 * dice


def second_loss(net: Net, there: torch.Tensor, edges: torch.Tensor, features: torch.Tensor, wanted: dict) -> torch.Tensor:
    boxes, kinds, of = looked_at(there.detach(), edges.detach(), wanted, net.kind.out_features - 1)
    if not len(boxes):
        return features.sum() * 0
    said, better = net.look(features, boxes)
    loss = functional.cross_entropy(said, kinds)
    real = kinds < net.kind.out_features - 1
    return loss + (1 - overlap(better[real], of[real])).mean() if real.any() else loss


def looked_at(there: torch.Tensor, edges: torch.Tensor, wanted: dict, nothing: int) -> tuple:
    """(boxes with their picture's number, classes, true edges): things' boxes shifted at random, and the first look's best."""
    true, kinds = wanted["boxes"], wanted["kinds"]
    shifted = true.repeat(SHIFTED, 1)
    side = (shifted[:, 3:] - shifted[:, 1:3]).repeat(1, 2)
    shifted[:, 1:] += side * 0.13 * torch.randn(side.shape).clamp(-2, 2)
    shifted[:, 3:] = torch.maximum(shifted[:, 3:], shifted[:, 1:3] + 1)
    found = [functional.pad(peaks(there[i], edges[i], 0.01, LOOKED_AT)[1], (1, 0), value=i) for i in range(len(there))]
    boxes = torch.cat([shifted, *found])
    best, which = torch.zeros(len(boxes)), torch.zeros(len(boxes), dtype=torch.long)
    if len(true):
        common = shared(boxes[:, None, 1:], true[None, :, 1:]) * (boxes[:, None, 0] == true[None, :, 0])
        best, which = common.max(1)
    middle = (0.5 * (boxes[:, 1:3] + boxes[:, 3:]) / STRIDE).long().clamp(0, there.shape[-1] - 1)
    counts = wanted["counts"][boxes[:, 0].long(), middle[:, 1], middle[:, 0]] > 0
    known = (best >= A_THING) | ((best < NOTHING) & counts)
    boxes, best, which = boxes[known], best[known], which[known]
    is_thing = best >= A_THING
    if not len(true):
        return boxes, torch.full((len(boxes),), nothing), torch.zeros(len(boxes), 4)
    return boxes, torch.where(is_thing, kinds[which], torch.tensor(nothing)), true[which, 1:]


def corners(edges: torch.Tensor) -> torch.Tensor:
    """Left, top, right, bottom about the same point, of distances to them (... x 4)."""
    return torch.cat([-edges[..., :2], edges[..., 2:]], -1)


def shared(one: torch.Tensor, other: torch.Tensor) -> torch.Tensor:
    """Intersection over union of boxes (... x 4)."""
    both = (torch.minimum(one[..., 2:], other[..., 2:]) - torch.maximum(one[..., :2], other[..., :2])).clamp(min=0).prod(-1)
    return both / ((one[..., 2:] - one[..., :2]).prod(-1) + (other[..., 2:] - other[..., :2]).prod(-1) - both).clamp(min=1e-6)


def overlap(one: torch.Tensor, other: torch.Tensor) -> torch.Tensor:
    """Generalised intersection over union of boxes (... x 4): below 0 when they lie apart."""
    both = (torch.minimum(one[..., 2:], other[..., 2:]) - torch.maximum(one[..., :2], other[..., :2])).clamp(min=0).prod(-1)
    either = (one[..., 2:] - one[..., :2]).prod(-1) + (other[..., 2:] - other[..., :2]).prod(-1) - both
    hull = (torch.maximum(one[..., 2:], other[..., 2:]) - torch.minimum(one[..., :2], other[..., :2])).prod(-1).clamp(min=1e-6)
    return both / either.clamp(min=1e-6) - (hull - either) / hull


class Batches:
    """Batch `step` of a training, the same whoever makes it. examples: has `size` and `random` to be set, and `draw()`."""

    def __init__(self, examples, seed: int, size: int = SIZE):
        self.examples, self.seed, self.size = examples, seed, size

    def __call__(self, step: int) -> tuple:
        torch.set_num_threads(1)
        random = self.examples.random = np.random.default_rng([self.seed, step])
        drawn = [self._four() if random.random() < FOURS else self._one(self.size) for _ in range(BATCH)]
        wanted = targets([example for example, _ in drawn])
        return np.stack([of for _, of in drawn]), {name: value.numpy() for name, value in wanted.items()}

    def _one(self, size: int) -> tuple:
        """An example, and what the net sees of it."""
        self.examples.size = size
        example = self.examples.draw()
        return example, seen(torch.from_numpy(example.grey)[None])[0].numpy()

    def _four(self) -> tuple:
        """Four small ones as one, each seen alone: what `find` sees of small pictures, and more things a step."""
        half, whole = self.size // 2, (self.size, self.size)
        boxes, kinds, owner, of = [], [], np.zeros(whole, np.int16), np.zeros((2, *whole), np.float32)
        for top, left in ((0, 0), (0, half), (half, 0), (half, half)):
            example, small = self._one(half)
            part = np.s_[top:top + half, left:left + half]
            owner[part] = np.where(example.owner > 0, example.owner + sum(len(one) for one in boxes), example.owner)
            of[(slice(None), *part)] = small
            boxes.append(example.boxes + np.array([left, top, left, top], np.float32))
            kinds.append(example.kinds)
        return Example(of[0], np.concatenate(boxes), np.concatenate(kinds), owner), of


def _prepare(batches: Batches) -> None:
    global _batches
    _batches = batches


def _batch(step: int) -> tuple:
    return _batches(step)


def train(batches: Batches, names: list, file: Path, steps: int, seed: int, jobs: int = 2, say=print) -> Net:
    """A net after so many steps. `file` keeps the state every minute: a training that was cut off goes on from there. All processors but
    one compute, one draws the pictures."""
    with multiprocessing.get_context("fork").Pool(1, _prepare, (batches,)) as drawing:
        torch.set_num_threads(max(1, jobs - 1))
        torch.manual_seed(seed)
        net = Net(len(names)).to(memory_format=torch.channels_last)
        optimiser = torch.optim.AdamW(net.parameters(), FASTEST, weight_decay=1e-4)
        mean = {name: value.clone() for name, value in net.state_dict().items()}  # over the last hundred steps
        first = 0
        if file.exists():
            held = torch.load(file, map_location="cpu")
            net.load_state_dict(held["net"])
            optimiser.load_state_dict(held["optimiser"])
            mean, first = held["mean"], held["step"]
        net.train()
        began = kept_at = time.monotonic()
        losses: list = []
        waiting = [drawing.apply_async(_batch, (step,)) for step in range(first, min(first + AHEAD, steps))]
        for step in range(first, steps):
            x, wanted = waiting.pop(0).get()
            if step + AHEAD < steps:
                waiting.append(drawing.apply_async(_batch, (step + AHEAD,)))
            for group in optimiser.param_groups:
                group["lr"] = FASTEST * min(1, (step + 1) / 100) * 0.5 * (1 + np.cos(np.pi * step / steps))
            x = torch.from_numpy(x).contiguous(memory_format=torch.channels_last)
            loss = loss_of(net, x, {name: torch.from_numpy(value) for name, value in wanted.items()})
            optimiser.zero_grad()
            loss.backward()
            torch.nn.utils.clip_grad_norm_(net.parameters(), 5.0)
            optimiser.step()
            keep = min(0.99, step / (step + 10))
            for name, value in net.state_dict().items():
                mean[name] = keep * mean[name] + (1 - keep) * value if value.is_floating_point() else value.clone()
            losses.append(loss.item())
            if time.monotonic() - kept_at > 60 or step + 1 == steps:
                kept_at = time.monotonic()
                partial = file.with_suffix(".part")
                torch.save({"net": net.state_dict(), "optimiser": optimiser.state_dict(), "mean": mean, "step": step + 1}, partial)
                partial.replace(file)
                left_s = (kept_at - began) / (step + 1 - first) * (steps - step - 1)
                say(f"step {step + 1} of {steps}, loss {np.mean(losses[-200:]):.3f}, {left_s / 60:.1f} min left", flush=True)
    net.load_state_dict(mean)
    return net.eval()
