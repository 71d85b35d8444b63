"""The built-in readers of measurement files, one format per file.

- `delimited_text`, `delimited_lines`, `delimited_layout`, `delimited_header`, `delimited_table`, `delimited_rows`,
  `delimited_columns`, `delimited_numbers`, `time_stamps` and `stated_sampling` help `csv`, `lvm` and `xlsx` to make out
  tables as rigs write them; `lvm_header` belongs to `lvm`, `rpc_header` to `rpc`, `tydex_channel` to `tydex`.
- `apart` lets libraries of native code read in a process of their own, whose other side is `serve`; `extra` says how to
  install an optional one.
- `unit_words` knows units in other spellings, `distinct` makes names unique, `flatten` turns the variables of `mat`,
  `npz` and `hdf5` files into columns, `option` reads what stands under `file_options`.
"""

from __future__ import annotations

import pluggy

hookimpl = pluggy.HookimplMarker("dashpot")


@hookimpl
def dashpot_formats() -> list[type]:
    """Every reader of this package."""
    from dashpot_formats.csv import Csv
    from dashpot_formats.hdf5 import Hdf5
    from dashpot_formats.json_matrix import JsonMatrix
    from dashpot_formats.lvm import Lvm
    from dashpot_formats.mat import Mat
    from dashpot_formats.mdf import Mdf
    from dashpot_formats.npz import Npz
    from dashpot_formats.petab import Petab
    from dashpot_formats.rpc import Rpc
    from dashpot_formats.tdms import Tdms
    from dashpot_formats.tydex import Tydex
    from dashpot_formats.xlsx import Xlsx

    return [Csv, Hdf5, JsonMatrix, Lvm, Mat, Mdf, Npz, Petab, Rpc, Tdms, Tydex, Xlsx]
