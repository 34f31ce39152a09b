"""Training of a net on generated pictures, which can be interrupted."""
import multiprocessing
import time
from pathlib import Path

import numpy as np
import torch
from torch.nn import functional

from generated import Examples
from net import STRIDE, Net, seen

SIZE, BATCH = 256, 16
AHEAD = 4  # batches that are drawn before they are wanted
FASTEST = 2e-3  # rate of learning


def targets(examples: list, classes: int) -> dict:
    """What the net should say of a batch, as tensors."""
    side, count = SIZE // STRIDE, len(examples)
    there = np.zeros((count, side, side), np.float32)
    counts = np.ones((count, side, side), np.float32)  # 0 where a thing does not count
    kind = np.full((count, side, side), -1, np.int64)
    edges = np.zeros((count, 4, side, side), np.float32)
    pixels = np.zeros((count, side, side), np.float32)
    y, x = np.mgrid[0:side, 0:side]
    for i, example in enumerate(examples):
        cells = example.owner.reshape(side, STRIDE, side, STRIDE)
        pixels[i] = (cells > 0).any((1, 3))
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
            kind[i][near] = example.kinds[place]
            at_x, at_y = (x[near] + 0.5) * STRIDE, (y[near] + 0.5) * STRIDE
            edges[i][:, near] = [at_x - left, at_y - top, right - at_x, bottom - at_y]
    return {name: torch.from_numpy(value) for name, value in
            dict(there=there, counts=counts, kind=kind, edges=edges.clip(0), pixels=pixels).items()}


def loss_of(said: tuple, wanted: dict) -> torch.Tensor:
    """Focal loss of the middles, cross-entropy of classes, overlap of boxes, cross-entropy and overlap of pixels."""
    there, kind, edges, pixels = said
    there, counts = there[:, 0], wanted["counts"]
    share = torch.sigmoid(there)
    is_middle = wanted["there"] == 1
    hit = functional.softplus(-there) * (1 - share) ** 2
    miss = functional.softplus(there) * share ** 2 * (1 - wanted["there"]) ** 4
    middles = is_middle.sum().clamp(min=1)
    loss = (torch.where(is_middle, hit, miss) * counts).sum() / middles
    known = wanted["kind"] >= 0
    if known.any():
        loss = loss + functional.cross_entropy(kind.permute(0, 2, 3, 1)[known], wanted["kind"][known])
        loss = loss + 2 * (1 - overlap(edges.permute(0, 2, 3, 1)[known], wanted["edges"].permute(0, 2, 3, 1)[known])).mean()
    share, of = torch.sigmoid(pixels[:, 0]), wanted["pixels"]
    cross = functional.binary_cross_entropy_with_logits(pixels[:, 0], of, reduction="none")
    dice = 1 - (2 * (share * of * counts).sum() + 1) / ((share * counts).sum() + (of * counts).sum() + 1)
    return loss + (cross * counts).mean() + 0.5 * dice


def overlap(one: torch.Tensor, other: torch.Tensor) -> torch.Tensor:
    """Generalised intersection over union of boxes about the same points, by their distances to the edges (... x 4)."""
    def sides(of):
        return of[..., 0] + of[..., 2], of[..., 1] + of[..., 3]
    inner, outer = sides(torch.minimum(one, other)), sides(torch.maximum(one, other))
    (wide_a, high_a), (wide_b, high_b) = sides(one), sides(other)
    both = inner[0] * inner[1]
    either = wide_a * high_a + wide_b * high_b - both
    hull = (outer[0] * outer[1]).clamp(min=1e-6)
    return both / either.clamp(min=1e-6) - (hull - either) / hull


class Batches:
    """Batch `step` of a training, the same whoever makes it."""

    def __init__(self, pictures: list, names: list, seed: int):
        self.seed, self.names = seed, names
        self.examples = Examples(pictures, names, SIZE, np.random.default_rng(seed))

    def __call__(self, step: int) -> tuple:
        torch.set_num_threads(1)
        self.examples.random = np.random.default_rng([self.seed, step])
        examples = [self.examples.draw() for _ in range(BATCH)]
        pictures = seen(torch.from_numpy(np.stack([example.grey for example in examples])))
        wanted = targets(examples, len(self.names))
        return pictures.numpy(), {name: value.numpy() for name, value in wanted.items()}


def _prepare(batches: Batches) -> None:
    global _batches
    _batches = batches


def _batch(step: int) -> tuple:
    return _batches(step)


def train(pictures: list, names: list, file: Path, steps: int, seed: int, jobs: int = 2, say=print) -> Net:
    """A net after so many steps. `file` keeps the state every minute: a training that was cut off goes on from there. All processors but
    one compute, one draws the pictures."""
    with multiprocessing.get_context("fork").Pool(1, _prepare, (Batches(pictures, names, seed),)) as drawing:
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
            said = net(torch.from_numpy(x).contiguous(memory_format=torch.channels_last))
            loss = loss_of(said, {name: torch.from_numpy(value) for name, value in wanted.items()})
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
