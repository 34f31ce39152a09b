"""Which record is read, and where results go."""
import glob
import os
import time

import ensonify
from ensonify_plot.errors import UserError


def open_record(given: str | None) -> ensonify.Record:
    """The record that the user means: a file, a folder with one, or what $ENSONIFY_OUT holds."""
    file = given or os.environ.get("ENSONIFY_OUT", ".")
    if os.path.isdir(file):
        found = sorted(glob.glob(os.path.join(glob.escape(file), "*.mcap")))
        if len(found) != 1:
            raise UserError(f"{file}: {'holds no record (*.mcap)' if not found else 'holds several records, name one'}")
        file = found[0]
    return ensonify.Record(file)


def folder_of(record: ensonify.Record) -> str:
    """Where results go unless the user says otherwise."""
    return os.path.dirname(os.path.abspath(record.file))


class Writer:
    """Writes results into a folder, which it makes, and says so."""

    def __init__(self, folder: str, quiet: bool):
        self.folder, self.quiet = folder, quiet
        self.began = time.monotonic()
        self.files: list = []
        os.makedirs(folder, exist_ok=True)

    def path(self, name: str) -> str:
        """Where a result goes; notes it. An old file of that name goes first, so that a failure leaves none."""
        path = os.path.join(self.folder, name)
        if os.path.exists(path):
            os.unlink(path)
        self.files.append(name)
        if not self.quiet:
            print(f"ensonify plot: {time.monotonic() - self.began:5.1f} s  {path}", flush=True)
        return path

    def picture(self, name: str, figure) -> None:
        """A PNG."""
        figure.savefig(self.path(name), pil_kwargs={"compress_level": 3})


def save_picture(record: ensonify.Record, out: str | None, name: str, figure) -> None:
    """One picture: as the file `out` if that ends in .png, else under `name` in the folder `out`."""
    folder, file = out or folder_of(record), name
    if out and out.lower().endswith(".png"):
        folder, file = os.path.split(os.path.abspath(out))
    elif out and os.path.splitext(out)[1] and not os.path.isdir(out):
        raise UserError(f"--out {out}: allowed are a file that ends in .png, or a folder")
    writer = Writer(folder, quiet=True)
    writer.picture(file, figure)
    print(os.path.join(folder, file))
