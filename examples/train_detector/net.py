"""The detector's network: from a grey picture to things, their boxes, classes and pixels, on a grid of every fourth pixel."""
import torch
from torch import nn

STRIDE = 4


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
    middle is there, those of each class, distances to left, top, right and bottom of its box in pixels, log odds of its pixels."""

    def __init__(self, classes: int):
        super().__init__()
        widths = (16, 32, 64, 112, 144)
        self.stem = nn.Sequential(nn.Conv2d(2, widths[0], 5, 2, 2, bias=False), nn.BatchNorm2d(widths[0]), nn.ReLU(inplace=True))
        self.down = nn.ModuleList(nn.Sequential(Block(of, to, 2), Block(to, to)) for of, to in zip(widths, widths[1:]))
        self.side = nn.ModuleList(nn.Conv2d(width, 48, 1) for width in widths[1:])
        self.join = nn.Sequential(nn.Conv2d(48, 48, 3, 1, 1, bias=False), nn.BatchNorm2d(48), nn.ReLU(inplace=True))
        self.heads = nn.Conv2d(48, 1 + classes + 4 + 1, 3, 1, 1)
        self.classes = classes
        nn.init.constant_(self.heads.bias[:1], -4.0)

    def forward(self, pictures):
        x, levels = self.stem(pictures), []
        for down in self.down:
            x = down(x)
            levels.append(x)
        x = self.side[-1](levels[-1])
        for level, side in zip(levels[-2::-1], list(self.side)[-2::-1]):
            x = side(level) + nn.functional.interpolate(x, size=level.shape[-2:], mode="nearest")
        there, kind, edges, pixels = self.heads(self.join(x)).split((1, self.classes, 4, 1), 1)
        return there, kind, nn.functional.softplus(edges) * 4 * STRIDE, pixels


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
    small = nn.functional.avg_pool2d(x, 4)
    half = max(1, max(small.shape[-2:]) // 16)
    small = nn.functional.avg_pool2d(small, 2 * half + 1, 1, half, count_include_pad=False)
    return nn.functional.interpolate(small, size=x.shape[-2:], mode="bilinear", align_corners=False)
