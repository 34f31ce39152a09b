"""What more generated cut-outs bring, and what each effect of the simulation brings: nets for whole cut-outs that are trained on generated
ones alone, scored on all real ones. The real ones choose nothing.
"""
import zlib
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import yaml

import cut_outs
import generated
import scenes
import whole
from groups import groups_of
from labelled import Unreadable
from worth import Held, digest, keep, of_masters, sets_in

AS_IT_IS, TEXTURE = "as it is", "speckle as texture"
EFFECTS = {AS_IT_IS: {}, TEXTURE: {"effects.speckle": False}, "no multipath": {"effects.multipath": False}, "constant gain": {"effects.tvg": False},
           "Lambert bottom": {"seabed.sediments.0": {"lambert_mu_db": {"uniform": [-35, -20]}}}}  # what `draw` of the recipe gets; `effects` of its head


@dataclass
class Textured(generated.Master):
    """A picture of mean levels, each sample multiplied by a Rayleigh number of its own: what is drawn over pictures elsewhere."""

    def read(self) -> tuple:
        amplitude, owner = super().read()
        random = np.random.default_rng(zlib.crc32(self.name.encode()))
        return amplitude * random.rayleigh(np.sqrt(0.5), amplitude.shape).astype(np.float32), owner


class Yardstick:
    """Scores of nets that are trained on generated cut-outs with several seeds. What was trained stays in `folder`."""

    def __init__(self, real: list, masters: list, folder: Path, steps: int, size: int, seeds: int, jobs: int):
        self.groups = groups_of(real)
        self.names = sorted({thing["class"] for master in masters for thing in master.facts["objects"]}
                            | {thing.name for picture in real for thing in picture.things if not thing.ignored})
        self.test = Held(real, self.groups, self.names)
        if self.test.kind != "balanced accuracy":
            raise Unreadable("the real pictures have boxes or masks; allowed here are cut-outs in a folder for each class")
        self.folder, self.steps, self.size, self.seeds, self.jobs = folder, steps, size, seeds, jobs
        self.used: dict = {}  # number of cut-outs by name

    def answers(self, name: str, of: cut_outs.CutOuts) -> list:
        if not of.of_class:
            raise Unreadable(f"{name}: no thing of the generated set can be seen; allowed is a set of more pictures")
        self.used[name] = of.count()
        return [self.test.said(whole.train([of], self.names, self.folder / f"{name.replace(' ', '_')}_{seed}.pt", self.steps, self.size, seed, self.jobs), self.size)
                for seed in range(1, self.seeds + 1)]

    def summary(self, answers: dict, against: str | None, draws: int = 400) -> dict:
        """Mean over seeds, and its difference to that of `against`, each with 95 % when groups and seeds are drawn again."""
        members = [np.flatnonzero(self.groups == of) for of in np.unique(self.groups)]
        random = np.random.default_rng(1)

        def of(which: np.ndarray, seeds: np.ndarray) -> dict:
            return {name: float(np.mean([self.test.score(some[seed], which) for seed in seeds])) for name, some in answers.items()}

        value = of(np.arange(len(self.groups)), np.arange(self.seeds))
        again = [of(np.concatenate([members[i] for i in random.integers(len(members), size=len(members))]), random.integers(self.seeds, size=self.seeds))
                 for _ in range(draws)]
        result = {name: {"cut_outs": self.used[name], "value": value[name], "interval": np.percentile([one[name] for one in again], [2.5, 97.5]).tolist()} for name in answers}
        for name in answers if against in answers else ():
            if name != against:
                result[name]["difference"] = value[name] - value[against]
                result[name]["difference_interval"] = np.percentile([one[name] - one[against] for one in again], [2.5, 97.5]).tolist()
        return result


def by_count(folder: Path, counts: list, real: list, out: Path, **settings) -> dict:
    """Scores with the first `count` cut-outs of a set, for each count that there is."""
    masters = generated.masters(sets_in(folder), "train")
    yardstick = Yardstick(real, masters, out, **settings)
    keep(out, steps=yardstick.steps, size=yardstick.size, generated=of_masters(masters), real=digest([picture.file for picture in real]))
    of = cut_outs.CutOuts(masters)
    return yardstick.summary({f"{count}": yardstick.answers(f"{count}", of.limited(count)) for count in counts if count <= of.count()}, None)


def by_effect(recipe: Path, pictures: int, count: int, real: list, out: Path, jobs: int, **settings) -> dict:
    """Scores with the same scenes, each effect switched off alone. The sets stay in `out`."""
    sets = {}
    for name in EFFECTS:
        folder = out / name.replace(" ", "_")
        scenes.generate(variant(recipe, name, out), pictures, folder, jobs)
        sets[name] = generated.masters([folder], "train")
    yardstick = Yardstick(real, sets[AS_IT_IS], out, jobs=jobs, **settings)
    keep(out, steps=yardstick.steps, size=yardstick.size, count=count, generated=of_masters(sets[AS_IT_IS]), real=digest([picture.file for picture in real]))
    sets[TEXTURE] = [Textured(master.folder, master.name, master.facts) for master in sets[TEXTURE]]
    return yardstick.summary({name: yardstick.answers(name, cut_outs.CutOuts(of).limited(count)) for name, of in sets.items()}, AS_IT_IS)


def variant(recipe: Path, effect: str, out: Path) -> Path:
    """The recipe with an effect switched off, in `out`."""
    out.mkdir(parents=True, exist_ok=True)
    try:
        whole_recipe = yaml.safe_load(recipe.read_text())
        whole_recipe["launch"] = str((recipe.parent / whole_recipe["launch"]).resolve())
        changes = {f"{whole_recipe['head']}.{key}" if key.startswith("effects.") else key: value for key, value in EFFECTS[effect].items()}
        whole_recipe["draw"] = {**(whole_recipe.get("draw") or {}), **changes}
    except (OSError, UnicodeDecodeError, yaml.YAMLError, KeyError, TypeError, AttributeError) as error:
        raise Unreadable(f"{recipe}: {type(error).__name__}: {error}; allowed is a recipe of `ensonify dataset`") from None
    file = out / f"{effect.replace(' ', '_')}.yaml"
    file.write_text(yaml.safe_dump(whole_recipe, sort_keys=False))
    return file


def as_text(result: dict) -> str:
    lines = ["balanced accuracy on the real cut-outs of nets that are trained on generated ones alone"]
    for name, of in result.items():
        line = f"  {name:<20} {of['cut_outs']:>5} cut-outs  {of['value']:.3f}  ({of['interval'][0]:.3f} to {of['interval'][1]:.3f})"
        if "difference" in of:
            line += f"   {of['difference']:+.3f}  ({of['difference_interval'][0]:+.3f} to {of['difference_interval'][1]:+.3f})"
        lines.append(line)
    return "\n".join(lines)
