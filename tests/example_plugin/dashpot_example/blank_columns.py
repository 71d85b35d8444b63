"""Files of an old bench: names in the first line, numbers below, blanks between them."""

import numpy as np

from dashpot import Reader, ReadingError, Table


class BlankColumns(Reader):
    """Names in the first line, numbers below, blanks between them."""

    word, suffixes = "blank_columns", (".bench",)

    def read(self, path, options):
        """The columns of the file; ReadingError where a line does not hold a number for each name."""
        first, *lines = path.read_text(encoding="utf-8").splitlines()
        names = first.split()
        for number, line in enumerate(lines, start=2):
            if len(line.split()) != len(names):
                message = f"expected {len(names)} numbers, got '{line}'"
                raise ReadingError(message, "save the file again, or cut the line off", number)
        return Table(dict(zip(names, np.array([line.split() for line in lines], dtype=float).T, strict=True)))
