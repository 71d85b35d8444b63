"""HDF5 files (.h5, .hdf5) with the library h5py, in a process of its own."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from dashpot.contract.reader import Reader, ReadingError, Table
from dashpot.text.problem import nearest
from dashpot_formats.apart import read_apart
from dashpot_formats.extra import require
from dashpot_formats.flatten import columns_of
from dashpot_formats.mat import read_hdf5
from dashpot_formats.option import check_options, get_option

_RATES = ("fs", "f_s", "sampling_rate", "sample_rate", "sampling_frequency")


class Hdf5(Reader):
    """Reads the vectors and matrices of one group: vectors by name, matrices as `name(1)`, `name(2)`, ...

    Without the option `group` it is the group with the most numbers; groups in groups are `outer.inner`. A single
    number called `fs`, `sampling_rate`, `sample_rate` or `sampling_frequency` is the sampling rate in Hz.
    """

    word = "hdf5"
    suffixes = (".h5", ".hdf5")
    extra = "matlab73"
    options = {
        "group": "the group that is read, `outer.inner` for one in another",
    }

    def read(self, path: Path, options: Mapping[str, object]) -> Table:
        check_options(options, self.options)
        require("h5py", self.extra, "HDF5 files")
        groups = _grouped(read_apart(read_hdf5, path, "HDF5 file").arrays)
        name = get_option(options, "group", str, None)
        if name is None and groups:
            name = max(groups, key=lambda each: sum(values.size for values in groups[each].values()))
        if name not in groups:
            known = [group or "the top" for group in groups]
            hint = nearest(str(name), known) or f"its groups are: {', '.join(known[:12]) or 'none'}"
            raise ReadingError(f"it has no group '{name}' of numbers", hint)
        columns = columns_of(groups[name])
        if not columns:
            raise ReadingError("it holds no vector or matrix of numbers", "name another 'group' under file_options")
        return Table(columns, sampling=_rate(groups[name]))


def _grouped(arrays: Mapping[str, np.ndarray]) -> dict[str, dict[str, np.ndarray]]:
    """The arrays by their group and name; a group of single numbers only is none."""
    groups: dict[str, dict[str, np.ndarray]] = {}
    for path, values in arrays.items():
        group, _, name = path.rpartition(".")
        groups.setdefault(group, {})[name] = values
    return {name: found for name, found in groups.items() if any(values.size > 1 for values in found.values())}


def _rate(variables: Mapping[str, np.ndarray]) -> float | None:
    found = [
        float(values.ravel()[0]) for name, values in variables.items() if name.lower() in _RATES and values.size == 1
    ]
    return found[0] if len(found) == 1 and np.isfinite(found[0]) and found[0] > 0.0 else None
