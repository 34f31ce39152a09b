#!/usr/bin/env python3
"""Checks the project's pages: sentences a reader can follow, the field's words, links that lead somewhere.

  check.py [ROOT]        names every offence with its line; exit code 1 if there is one
  check.py --self-test   checks the checker on a page with planted offences
  check.py --length N    the longest N sentences

A sentence has at most 35 words. Code, formulas and addresses count as one word each; a cell of a table, an item of a list and
a heading are units of their own. Generated pages are checked for links only.

What is said of a parameter (launch/schema) or of a message's field (messages.md) is shown alone, as hover text or as a row: it
begins with a noun, and points at no neighbour.
"""
import functools
import json
import pathlib
import re
import subprocess
import sys
import tempfile

LONGEST = 35
GENERATED = {"docs/manual/messages.md"}

# What the project's pages do not say, with what they say instead (the field's words: docs/glossary.md).
WORDS = (
    (r"hears?|heard|hearing", "receives"),
    (r"listens?|listened|listening", "receives"),
    (r"lights|lighted", "insonifies"),
    (r"tells?|told|telling", "reports, says"),
    (r"believes?|believed", "estimates, assumes"),
    (r"(?:rays?|beams?|sound|paths?) (?:meets?|met)", "hits, reaches"),
    (r"(?:flies|flown|flying|flew|fly) (?:a |the |its |by )?(?:boats?|vessels?|ships?|lines?|missions?|surveys?)", "surveys, runs"),
    (r"(?:pistons?|heads?|sonars?|lobes?|fans?|arrays?|altimeters?|beams?) looks?", "points, insonifies"),
    (r"(?:is|are|be) sound(?=[.,;:)]| and| or)", "is valid"),
    (r"sidescan sees|head sees|heads see|beams? sees?", "insonifies, receives"),
)
# What rots: a count of lines, a date on which somebody did something.
ROT = (
    (r"\d[\d,.]* lines of (?:C\+\+|code|Python)", "a count of lines"),
    (r"\b20[12]\d-[01]\d-[0-3]\d\b(?!T)", "a date"),
    (r"\b(?:today|tomorrow|yesterday|last (?:week|month|year))\b", "a time that passes"),
)
SPOKEN = [(re.compile(rf"\b(?:{bad})\b", re.I), f'say "{good}"') for bad, good in WORDS]  # in launch files, too
FORBIDDEN = SPOKEN + [(re.compile(bad, re.I), f"{what} goes out of date") for bad, what in ROT]

# What a sentence that stands alone does not begin with, and does not hold.
LEANING = re.compile(
    r"(?:of|its|it|as|to|beyond|farther|nearer|that|they|he|how|when|where|at|in|on|from|for|with|by|after|before|between|below"
    r"|above|than|which|what|whether|such|instead|also|else|and|or|so|there|these|those|them|this|do|does|is|are|if|while|under"
    r"|without|over|off|true:|never|likewise|re|\[)(?![\w-])|-\d", re.I)
POINTING = re.compile(r"\b(?:the same(?! (?:as|for|of all))|likewise|such an?|as above|(?<=of )that (?!are|is))\b")

LIST_ITEM = re.compile(r"\s{0,3}(?:[-*+]|\d+\.) ")
# A full stop that ends no sentence.
ABBREVIATION = re.compile(r"\b(?:e\.g|i\.e|etc|cf|vs|approx|Fig|Eq|No|al|St|Dr)\.$", re.I)


def without_code(text):
    """The page with fenced code, comments and indented code blanked; its lines keep their numbers."""
    blank = lambda match: re.sub(r"[^\n]", "", match[0])
    text = re.sub(r"^ *(```|~~~).*?^ *\1[^\n]*", blank, text, flags=re.M | re.S)
    text = re.sub(r"<!--.*?-->", blank, text, flags=re.S)
    lines, in_list, in_code, after_empty = [], False, False, True
    for line in text.split("\n"):
        if line.strip():
            indented = line.startswith(("    ", "\t"))
            in_list = bool(LIST_ITEM.match(line)) or (in_list and (line.startswith("  ") or not after_empty))
            in_code = indented and not in_list and (in_code or after_empty)
        lines.append("" if in_code else line)
        after_empty = not line.strip()
    return "\n".join(lines)


def plain(text):
    """Prose as it is read: code and formulas one word each, links by their text, no emphasis."""
    text = re.sub(r"`[^`]*`", "CODE", text)
    text = re.sub(r"\$[^$\n]+\$", "FORMULA", text)
    text = re.sub(r"!?\[((?:[^\[\]]|\[[^\]]*\])*)\]\([^)\s]*\)", r"\1", text)
    text = re.sub(r"<?https?://\S+", "ADDRESS", text)
    return re.sub(r"[*_]{1,2}(?=\S)|(?<=\S)[*_]{1,2}", "", text)


def units(text):
    """(line number, prose) of each paragraph, list item, heading and cell."""
    collected, began = [], 0
    for number, line in enumerate(text.splitlines() + [""], 1):
        stripped = line.strip()
        starts = re.match(r"^(?:#+ |[-*+] |\d+\. |> )", stripped)
        if collected and (not stripped or starts or stripped.startswith("|")):
            yield began, " ".join(collected)
            collected = []
        if stripped.startswith("|"):
            yield from ((number, cell.strip()) for cell in re.split(r"(?<!\\)\|", re.sub(r"`[^`]*`", "CODE", stripped)))
        elif stripped:
            began = began if collected else number
            collected.append(stripped[starts.end():] if starts else stripped)
            if stripped.startswith("#"):
                yield began, collected.pop()


def sentences(prose):
    """The sentences of a paragraph."""
    begin = 0
    for stop in re.finditer(r"[.!?][\")\]*_]*(?=\s+[\"(\[*_`]*[A-Z0-9\[(]|\s*$)", prose):
        if ABBREVIATION.search(prose[: stop.start() + 1]):
            continue
        yield prose[begin: stop.end()].strip()
        begin = stop.end()
    if prose[begin:].strip():
        yield prose[begin:].strip()


def words(sentence):
    return sum(1 for token in sentence.split() if re.search(r"\w", token))


def anchor(heading):
    """The anchor that GitHub and the site make of a heading."""
    text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", heading)
    return re.sub(r"[^\w\- ]", "", re.sub(r"[`*]", "", text).strip().lower()).replace(" ", "-")


@functools.cache
def anchors(page):
    text = re.sub(r"^ *```.*?^ *```", "", page.read_text(encoding="utf-8"), flags=re.M | re.S)
    found = set()
    for heading in re.findall(r"^#+ +(.*?)\s*#*$", text, re.M):
        name, count = anchor(heading), 1
        while name in found:  # the second of two equal headings gets a number
            name, count = f"{anchor(heading)}-{count}", count + 1
        found.add(name)
    return found | set(re.findall(r'<a (?:id|name)="([^"]+)"', text))


def links(text):
    """(line number, target) of each [text](target) and image."""
    text = re.sub(r"`[^`\n]*`", "CODE", text)
    for match in re.finditer(r"\]\(([^)\s]+)\)", text):
        yield text.count("\n", 0, match.start()) + 1, match[1]


def problems_of_links(page, text):
    for number, target in links(text):
        if re.match(r"[a-z]+:", target):
            continue
        path, _, name = target.partition("#")
        aimed = (page.parent / path) if path else page
        if not aimed.exists():
            yield number, f"{target} does not exist"
        elif name and aimed.suffix == ".md" and name not in anchors(aimed):
            yield number, f"{target}: no such heading"


def problems_of_prose(text):
    for number, unit in units(text):
        prose = plain(unit)
        for sentence in sentences(prose):
            if words(sentence) > LONGEST:
                yield number, f"{words(sentence)} words: {sentence}"
        for pattern, advice in FORBIDDEN:
            for bad in pattern.finditer(prose):
                yield number, f'"{bad[0]}": {advice}'


def pages(root, pattern="*.md"):
    listed = subprocess.run(["git", "-c", f"safe.directory={root}", "-C", root, "ls-files", "--cached", "--others",
                             "--exclude-standard", pattern], capture_output=True, text=True)
    if listed.returncode != 0:  # not a checkout
        return sorted(p for p in root.rglob(pathlib.Path(pattern).name)
                      if not {"build", "out", "node_modules"} & set(p.relative_to(root).parts))
    return sorted(p for p in map(root.joinpath, set(listed.stdout.splitlines())) if p.exists())


def problem_of_sentence(sentence):
    """Why a parameter's or field's sentence does not stand alone; "" if it does."""
    if LEANING.match(sentence):
        return f'"{sentence}": begin with a noun'
    pointing = POINTING.search(sentence)
    return f'"{sentence}": "{pointing[0]}" points at a neighbour' if pointing else ""


def described(schema, path=""):
    """(path of keys, sentence) of every description in a JSON Schema."""
    for key, value in schema.items() if isinstance(schema, dict) else enumerate(schema):
        if key == "description" and isinstance(value, str):
            yield path, value
        elif isinstance(value, (dict, list)):
            yield from described(value, path if key in ("properties", "anyOf", "items") else f"{path}.{key}".lstrip("."))


def problems_of_sentences(root):
    for file in sorted(root.glob("launch/schema/*.json")):
        for key, sentence in described(json.loads(file.read_text(encoding="utf-8"))):
            if key and (problem := problem_of_sentence(sentence)):
                yield f"{file.relative_to(root).as_posix()}: {key}: {problem}"
    fields = root / "docs/manual/messages.md"
    for number, line in enumerate(fields.read_text(encoding="utf-8").splitlines() if fields.exists() else [], 1):
        row = re.fullmatch(r"\| `\w+` \|[^|]*\|[^|]*\| (.*) \|", line)
        if row and (problem := problem_of_sentence(row[1])):
            yield f"docs/manual/messages.md:{number}: {problem}"


def problems(root):
    found, count = list(problems_of_sentences(root)), 0
    for page in pages(root):
        count += 1
        name = page.relative_to(root).as_posix()
        text = without_code(page.read_text(encoding="utf-8"))
        offences = list(problems_of_links(page, text))
        if name not in GENERATED:
            offences += problems_of_prose(text)
        found += [f"{name}:{number}: {problem}" for number, problem in sorted(offences)]
    for file in pages(root, "launch/*.yaml"):
        for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
            found += [f"{file.relative_to(root).as_posix()}:{number}: \"{bad[0]}\": {advice}"
                      for pattern, advice in SPOKEN for bad in pattern.finditer(line)]
    return found, count


LONG = "A sentence " + "of many words " * 12
# Lines of a page, each with the words that its problem must hold, or None when it is fine.
PLANTED = (
    ("# First heading, with `code`", None), ("", None),
    ("See [there](#first-heading-with-code) and [nothing](#second).", "no such heading"), ("", None),
    ("See [the page](other.md) and [a file](none.md).", "does not exist"), ("", None),
    ("[The other](other.md#here) and `[code](none.md)` are fine.", None), ("", None),
    (f"{LONG}.", "38 words"), ("", None),
    (f"Short. {LONG[:40]}. {LONG[:60]}.", None), ("", None),
    (f"- {LONG[:90]}", None), (f"- {LONG[:90]}", None), ("", None),
    (f"| {LONG[:90]} | {LONG[:90]} |", None), (f"| {LONG} | x |", "38 words"), ("", None),
    ("The sidescan hears a pinger.", "receives"), ("", None), ("The piston looks down.", "points"), ("", None),
    ("An autopilot flies a boat.", "surveys"), ("", None),
    ("The file is sound.", "valid"), ("", None), ("The speed of sound is what it is.", None), ("", None),
    ("It takes 313 lines of C++.", "count of lines"), ("", None),
    ("Seen on 2024-02-03.", "a date"), ("", None),
    ("```", None), (f"{LONG} hears [x](none.md)", None), ("```", None),
)


def self_test():
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        (root / "other.md").write_text("# Here\n", encoding="utf-8")
        (root / "page.md").write_text("\n".join(line for line, _ in PLANTED) + "\n", encoding="utf-8")
        (root / "launch").mkdir()
        (root / "launch/x.yaml").write_text("a: 1  # the head hears it\n", encoding="utf-8")
        (root / "launch/schema").mkdir()
        (root / "launch/schema/x.json").write_text(json.dumps({"properties": {
            "depth_m": {"description": "of the body"}, "width_m": {"description": "the same of its sides"},
            "height_m": {"description": "height of the body", "anyOf": [{"properties": {"a": {"description": "-3 dB"}}}]}}}))
        found = {}
        for text in problems(root)[0]:
            place, problem = re.fullmatch(r"(\S+\.json: \S+|\S+?): (.*)", text, re.S).groups()
            found.setdefault(place, []).append(problem)
    expected = {f"page.md:{number}": part for number, (_, part) in enumerate(PLANTED, 1) if part}
    expected["launch/x.yaml:1"] = "receives"
    for key, part in (("depth_m", "noun"), ("width_m", "neighbour"), ("height_m.0.a", "noun")):
        expected[f"launch/schema/x.json: {key}"] = part
    wrong = [f"not found: {place} ({part})" for place, part in expected.items()
             if not any(part in problem for problem in found.get(place, []))]
    wrong += [f"found by mistake: {place}: {problem}" for place, all_found in found.items() for problem in all_found
              if place not in expected]
    print("\n".join(wrong) or f"{len(expected)} planted offences found, nothing else")
    return 1 if wrong else 0


def longest(root, count):
    """Prints the longest sentences of all pages."""
    measured = []
    for page in pages(root):
        for number, unit in units(without_code(page.read_text(encoding="utf-8"))):
            measured += [(words(s), f"{page.relative_to(root)}:{number}: {s}") for s in sentences(plain(unit))]
    for length, text in sorted(measured, reverse=True)[:count]:
        print(length, text)


def main():
    arguments = sys.argv[1:]
    root = pathlib.Path(__file__).resolve().parent.parent
    if arguments == ["--self-test"]:
        return self_test()
    if arguments[:1] == ["--length"]:
        return longest(root, int(arguments[1]))
    found, count = problems(pathlib.Path(arguments[0]).resolve() if arguments else root)
    print("\n".join(found + [f"docs: {count} pages, {len(found)} problems"]))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
