"""The built-in readers of measurement files, one format per file.

`delimited_text`, `delimited_layout`, `delimited_header`, `time_stamps` and `stated_sampling` help `csv` to make out
tables as rigs write them, `unit_words` knows units in other spellings; `flatten` turns the variables of `mat` and `npz`
files into columns.
"""

from __future__ import annotations

import pluggy

hookimpl = pluggy.HookimplMarker("dashpot")


@hookimpl
def dashpot_formats() -> list[type]:
    """Every reader of this package."""
    from dashpot_formats.csv import Csv
    from dashpot_formats.json_matrix import JsonMatrix
    from dashpot_formats.mat import Mat
    from dashpot_formats.npz import Npz

    return [Csv, Mat, Npz, JsonMatrix]
