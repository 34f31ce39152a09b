"""The detector's network. A first look finds places and boxes of things on a grid of every fourth pixel; a second look at each box says
what is in it, and where its edges are."""
import torch
from torch import nn
from torch.nn import functional

STRIDE = 4
LEAST_EDGE, LONGEST_EDGE = 0.5, 400.0  # pixels from the middle of a box to its edges, as the first look may say
ROUND = 7  # points along each side of a box at which the second look takes features
AROUND = 1.25  # of the box's sides that they span: what lies round a thing tells of it too


class Block(nn.Module):
    """Two convolutions and what came in."""

    def __init__(self, of: int, to: int, stride: int = 1):
        super().__init__()
        self.body = nn.Sequential(nn.Conv2d(of, to, 3, stride, 1, bias=False), nn.BatchNorm2d(to), nn.ReLU(inplace=True),
                                  nn.Conv2d(to, to, 3, 1, 1, bias=False), nn.BatchNorm2d(to))
        self.past = nn.Identity() if of == to and stride == 1 else nn.Sequential(
            nn.AvgPool2d(stride) if stride > 1 else nn.Identity(), nn.Conv2d(of, to, 1, bias=False), nn.BatchNorm2d(to))

    def forward(self, x):
        return torch.relu(self.body(x) + self.past(x))


class Net(nn.Module):
    """Under two million parameters, from random weights.

    forward(pictures: n x 2 x rows x columns, both multiples of 32) gives four maps of every fourth pixel: log odds that a thing's
    middle is there, distances to left, top, right and bottom of its box in pixels, log odds of its pixels, and features for look().
    look(features, boxes: things x 5, picture's number and edges in pixels) gives log odds of each class and, last, of nothing
    (things x classes + 1), and the boxes' better edges (things x 4)."""

    def __init__(self, classes: int):
        super().__init__()
        widths = (16, 32, 64, 112, 144)
        self.stem = nn.Sequential(nn.Conv2d(2, widths[0], 5, 2, 2, bias=False), nn.BatchNorm2d(widths[0]), nn.ReLU(inplace=True))
        self.down = nn.ModuleList(nn.Sequential(Block(of, to, 2), Block(to, to)) for of, to in zip(widths, widths[1:]))
        self.side = nn.ModuleList(nn.Conv2d(width, 48, 1) for width in widths[1:])
        self.join = nn.Sequential(nn.Conv2d(48, 48, 3, 1, 1, bias=False), nn.BatchNorm2d(48), nn.ReLU(inplace=True))
        self.heads = nn.Conv2d(48, 1 + 4 + 1, 3, 1, 1)
        nn.init.constant_(self.heads.bias[:1], -4.0)
        self.taken = nn.Sequential(nn.Linear(48 * ROUND * ROUND + 2, 176), nn.ReLU(inplace=True), nn.Linear(176, 128), nn.ReLU(inplace=True))
        self.kind, self.edges = nn.Linear(128, classes + 1), nn.Linear(128, 4)
        nn.init.normal_(self.edges.weight, std=1e-3)
        nn.init.zeros_(self.edges.bias)

    def forward(self, pictures):
        x, levels = self.stem(pictures), []
        for down in self.down:
            x = down(x)
            levels.append(x)
        x = self.side[-1](levels[-1])
        for level, side in zip(levels[-2::-1], list(self.side)[-2::-1]):
            x = side(level) + functional.interpolate(x, size=level.shape[-2:], mode="nearest")
        features = self.join(x)
        there, edges, pixels = self.heads(features).split((1, 4, 1), 1)
        return there, (2 * STRIDE * torch.exp(edges.clamp(-4, 5))).clamp(LEAST_EDGE, LONGEST_EDGE), pixels, features

    def look(self, features, boxes):
        middle, side = 0.5 * (boxes[:, 1:3] + boxes[:, 3:5]), (boxes[:, 3:5] - boxes[:, 1:3]).clamp(min=1.0)
        span = ((torch.arange(ROUND) + 0.5) / ROUND - 0.5) * AROUND
        size = STRIDE * torch.tensor([features.shape[3], features.shape[2]])
        at = 2 * (middle[:, None] + side[:, None] * span[None, :, None]) / size - 1  # things x points x (column, row)
        grid = torch.stack([at[:, None, :, 0].expand(-1, ROUND, -1), at[:, :, None, 1].expand(-1, -1, ROUND)], -1)
        of = torch.cat([functional.grid_sample(features[i:i + 1], grid[boxes[:, 0] == i].reshape(1, -1, ROUND, 2), align_corners=False)[0]
                        .reshape(features.shape[1], -1, ROUND, ROUND).transpose(0, 1) for i in range(len(features))])
        order = torch.cat([torch.nonzero(boxes[:, 0] == i)[:, 0] for i in range(len(features))])
        shape = torch.stack([side.log().mean(1) - 3, (side[:, 0] / side[:, 1]).log()], 1)
        x = self.taken(torch.cat([of[torch.argsort(order)].flatten(1), shape], 1))
        shift = self.edges(x)
        middle, side = middle + side * shift[:, :2], side * torch.exp(shift[:, 2:].clamp(-1.5, 1.5))
        return self.kind(x), torch.cat([middle - 0.5 * side, middle + 0.5 * side], 1)


def peaks(there: torch.Tensor, edges: torch.Tensor, least_score: float, most: int) -> tuple:
    """(scores, boxes in pixels) of the highest points of a picture's map of middles, the highest first."""
    score = torch.sigmoid(there)
    top = functional.max_pool2d(score[None, None], 3, 1, 1)[0, 0]
    rows, columns = torch.nonzero((score == top) & (score >= least_score), as_tuple=True)
    best = torch.argsort(score[rows, columns], descending=True)[:most]
    rows, columns = rows[best], columns[best]
    x, y = (columns + 0.5) * STRIDE, (rows + 0.5) * STRIDE
    left, top, right, bottom = edges[:, rows, columns]
    return score[rows, columns], torch.stack([x - left, y - top, x + right, y + bottom], 1)


def seen(grey: torch.Tensor) -> torch.Tensor:
    """What the network sees of pictures (n x rows x columns, 0..1): levels between the 1st and the 99.5th hundredth, and what differs
    from the neighbourhood, in its own deviations. Of real and generated pictures alike. Gives n x 2 x rows x columns."""
    flat = grey.flatten(1)
    step = max(1, flat.shape[1] // 16384)
    low, high = (torch.quantile(flat[:, ::step], at, dim=1)[:, None, None] for at in (0.01, 0.995))
    level = ((grey - low) / (high - low).clamp(min=0.02)).clamp(0, 1.5)[:, None]
    mean, square = _blurred(level), _blurred(level * level)
    local = (level - mean) / (square - mean * mean).clamp(min=1e-3).sqrt().clamp(min=0.05)
    return torch.cat([2 * level - 1, 0.5 * local.clamp(-3, 5)], 1)


def _blurred(x: torch.Tensor) -> torch.Tensor:
    """Over an eighth of the picture's longer side, at a quarter of its resolution."""
    small = functional.avg_pool2d(x, 4)
    half = max(1, max(small.shape[-2:]) // 16)
    small = functional.avg_pool2d(small, 2 * half + 1, 1, half, count_include_pad=False)
    return functional.interpolate(small, size=x.shape[-2:], mode="bilinear", align_corners=False)
