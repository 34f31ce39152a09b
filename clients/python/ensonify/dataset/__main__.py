"""What `ensonify dataset` calls: ready, make, join, check."""
import argparse
import sys

from ensonify.session import EXIT_BAD_INPUT, RunError


def parser() -> argparse.ArgumentParser:
    of = argparse.ArgumentParser(prog="python -m ensonify.dataset", description="Pictures of scenes, and the set that they become.")
    verbs = of.add_subparsers(dest="verb", required=True)
    verbs.add_parser("ready", help="say whether all that is needed is there")
    make = verbs.add_parser("make", help="make the pictures of runs, as they end")
    make.add_argument("folder", help="folder of the set")
    make.add_argument("socket", type=int, help="descriptor of a socket: scenes come as lines, and for each goes a line back")
    make.add_argument("--keep", action="store_true", help="leave the records")
    all_of = verbs.add_parser("join", help="make the set of all pictures")
    all_of.add_argument("folder", help="folder of the set")
    all_of.add_argument("--pictures", type=int, required=True, help="number of pictures")
    all_of.add_argument("--only", type=int, help="this picture alone")
    all_of.add_argument("--sources", nargs="*", default=[], help="folders of shards")
    check = verbs.add_parser("check", help="find what is on two sides")
    check.add_argument("set", help="a set, or the folder that it stands in")
    return of


def run(args: argparse.Namespace) -> int:
    if args.verb == "check":
        from ensonify.dataset.check import leaks, rows_of

        rows = rows_of(args.set)
        found = leaks(rows)
        for leak in found[:20]:
            print(leak)
        print(f"{args.set}: {len(rows)} pictures, {len(found) or 'no'} leaks")
        return 1 if found else 0
    from ensonify.dataset import join, maker

    if args.verb == "make":
        maker.serve(args.folder, args.socket, args.keep)
    elif args.verb == "join":
        print(join.join(args.folder, args.pictures, args.only, args.sources))
    return 0


def main(arguments: list | None = None) -> int:
    args = parser().parse_args(arguments)
    try:
        return run(args)
    except RunError as error:
        print(f"ensonify dataset: {error}", file=sys.stderr)
        return error.code
    except ModuleNotFoundError as error:
        if error.name != "PIL":
            raise
        print("ensonify dataset: needs Pillow: pip install 'ensonify[labels]'", file=sys.stderr)
        return EXIT_BAD_INPUT
    except OSError as error:
        print(f"ensonify dataset: {error.filename}: {error.strerror}", file=sys.stderr)
        return 5


if __name__ == "__main__":
    sys.exit(main())
