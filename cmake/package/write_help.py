"""Writes manual pages and shell completions as they land below <prefix>/share.
     write_help.py PROGRAMS VERSION SHARE      PROGRAMS: folder with `ensonify` and the programs beside it"""
import gzip
import pathlib
import sys

from completions import completions
from help_tree import read_tree
from man_pages import man_pages


def main(programs: str, version: str, share: str) -> None:
    tree = read_tree(programs)
    pages = {f"man/man1/{name}.1.gz": gzip.compress(text.encode(), mtime=0) for name, text in man_pages(tree, version).items()}
    for name, content in {**pages, **{name: text.encode() for name, text in completions(tree).items()}}.items():
        file = pathlib.Path(share, name)
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(content)


if __name__ == "__main__":
    main(*sys.argv[1:])
