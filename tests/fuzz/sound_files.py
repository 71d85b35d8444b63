"""Sound files of every format, small, in the variants that their readers tell apart."""

from __future__ import annotations

import io
import json
import struct
from pathlib import Path

import numpy as np

TIME = np.arange(48) / 100
WAY, FORCE = 3 * np.sin(20 * TIME), 800 * np.sin(20 * TIME + 0.3)
TABLE = np.column_stack([TIME, WAY, FORCE])


def sound_files(word: str, folder: Path) -> list[bytes]:
    """The contents of some sound files. ImportError when a library that writes them is missing."""
    return _WRITERS[word](folder)


def _csv(folder: Path) -> list[bytes]:
    def rows(delimiter: str, decimal: str = ".") -> str:
        return "".join(delimiter.join(f"{x:.5g}".replace(".", decimal) for x in row) + "\n" for row in TABLE)

    stamps = "".join(f"12.03.2024 10:11:{t:06.3f};{x:.4g}\n" for t, x in zip(TIME, WAY, strict=True))
    return [
        ("Prüfstand\nt;x;F\ns;mm;N\n" + rows(";", ",")).encode("cp1252"),
        ('# remark\n"Time [s]","Way [mm]","Force [N]"\n' + rows(",")).encode(),
        ("t\tx\tF\n" + rows("\t")).encode("utf-16"),
        ("   t   x   F\n" + rows("   ")).encode(),
        ("when;x\n" + stamps).encode(),
        b"Sample Rate: 100\n" + rows(";").encode(),
    ]


def _json(folder: Path) -> list[bytes]:
    named = {"t": TIME.tolist(), "F": FORCE.tolist()}
    return [json.dumps(content).encode() for content in (TABLE.tolist(), {"data": TABLE.tolist()}, named)]


def _npz(folder: Path) -> list[bytes]:
    contents = []
    for save in (np.savez, np.savez_compressed):
        stream = io.BytesIO()
        save(stream, t=TIME, F=FORCE.astype("f4"), m=TABLE)
        contents.append(stream.getvalue())
    stream = io.BytesIO()
    np.save(stream, TABLE)
    return [*contents, stream.getvalue()]


def _mat(folder: Path) -> list[bytes]:
    from scipy.io import savemat

    contents = []
    variables = {"t": TIME, "s": {"F": FORCE, "n": "text"}, "c": np.array(["a", 1], dtype=object), "m": TABLE}
    for options in ({}, {"do_compression": True}, {"format": "4"}):
        stream = io.BytesIO()
        savemat(stream, {"t": TIME, "m": TABLE} if options.get("format") else variables, **options)
        contents.append(stream.getvalue())
    return [*contents, _mat73(folder)]


def _mat73(folder: Path) -> bytes:
    import h5py

    path = folder / "sound.h5"
    with h5py.File(path, "w", userblock_size=512) as file:
        for name, values in (("t", TIME), ("m", TABLE), ("s/F", FORCE)):
            file.create_dataset(name, data=values.T, compression="gzip" if name == "m" else None)
            file[name].attrs["MATLAB_class"] = np.bytes_("double")
    content = path.read_bytes()
    return b"MATLAB 7.3 MAT-file".ljust(512) + content[512:]


def _hdf5(folder: Path) -> list[bytes]:
    import h5py

    contents = []
    for options in ({}, {"compression": "gzip", "chunks": (16,)}):
        path = folder / "sound.hdf5"
        with h5py.File(path, "w") as file:
            for name, values in (("sweep/t", TIME), ("sweep/F", FORCE), ("noise/x", WAY)):
                file.create_dataset(name, data=values, **options)
            file["sweep/fs"] = 100.0
            file["note"] = "rig"
        contents.append(path.read_bytes())
    return contents


def _lvm(folder: Path) -> list[bytes]:
    return [_lvm_file(clocks, decimal) for clocks in ("One", "Multi", "No") for decimal in ".,"]


def _lvm_file(clocks: str, decimal: str) -> bytes:
    heading = (
        f"LabVIEW Measurement\t\nWriter_Version\t2\nSeparator\tTab\nDecimal_Separator\t{decimal}\n"
        f"X_Columns\t{clocks}\nDate\t2024/02/28\nTime\t15:53:23\n***End_of_Header***\t\n\t\n"
    )
    named = {"One": "X_Value\tWay\tForce", "Multi": "X_Value\tWay\tX_Value\tForce", "No": "X_Value\tWay\tForce"}
    rows = {
        "One": "{0:.6f}\t{1:.6f}\t{2:.6f}",
        "Multi": "{0:.6f}\t{1:.6f}\t{0:.6f}\t{2:.6f}",
        "No": "\t{1:.6f}\t{2:.6f}",
    }
    parts = []
    for part in (TABLE[:24], TABLE[24:]):
        channels = (
            f"Channels\t2\nSamples\t24\t24\nDate\t2024/02/28\t2024/02/28\nTime\t15:53:23\t15:53:23\n"
            f"Y_Unit_Label\tmm\tNewton\nX_Dimension\tTime\tTime\nX0\t{part[0, 0]:.6f}\t{part[0, 0]:.6f}\n"
            f"Delta_X\t0.01\t0.01\n***End_of_Header***\t\t\n{named[clocks]}\tComment\n"
        )
        parts.append(channels + "".join(rows[clocks].format(*row) + "\t\n" for row in part) + "\n")
    return (heading + "".join(parts).replace(".", decimal)).replace("\n", "\r\n").encode()


def _rpc(folder: Path) -> list[bytes]:
    return [_rpc_file(order, kind) for order in "<>" for kind in "hf"]


def _rpc_file(order: str, kind: str) -> bytes:
    values = {
        "FORMAT": {"<": "BINARY_IEEE_LITTLE_END", ">": "BINARY_IEEE_BIG_END"}[order],
        "NUM_HEADER_BLOCKS": 5,
        "NUM_PARAMS": 19,
        "FILE_TYPE": "TIME_HISTORY",
        "DELTA_T": 0.01,
        "DATA_TYPE": {"h": "SHORT_INTEGER", "f": "FLOATING_POINT"}[kind],
        "CHANNELS": 3,
        "PTS_PER_FRAME": 8,
        "PTS_PER_GROUP": 16,
        "FRAMES": 6,
    }
    for number, name in enumerate(("Time", "Way", "Force"), 1):
        values |= {f"DESC.CHAN_{number}": name, f"UNITS.CHAN_{number}": "mm", f"SCALE.CHAN_{number}": 0.1}
    header = b"".join(struct.pack("32s96s", key.encode(), str(value).encode()) for key, value in values.items())
    numbers = TABLE.T.reshape(3, 3, 16).swapaxes(0, 1).astype(order + {"h": "i2", "f": "f4"}[kind])
    return header.ljust(5 * 512, b"\0") + numbers.tobytes()


def _tydex(folder: Path) -> list[bytes]:
    head = "**HEADER\nRELEASE   Release of TYDEX-Format                 1.3\n**MEASURCHANNELS\n"
    names = (("RUNTIME", "Running time", "s"), ("DISTGRND", "Distance", "mm"), ("FZW", "Vertical force", "N"))
    channels = "".join(f"{name:<10}{remark:<30}{unit:<10}{1.0:<10}\n" for name, remark, unit in names)
    forms = ("{:>10.4g}", "{:g} ")
    rows = ["".join("".join(form.format(x) for x in row) + "\n" for row in TABLE) for form in forms]
    return [(head + channels + "**MEASURDATA\n" + text + "**END\n").encode() for text in rows]


def _tdms(folder: Path) -> list[bytes]:
    from nptdms import ChannelObject, TdmsWriter

    path = folder / "sound.tdms"
    with TdmsWriter(path) as writer:
        for _ in range(2):
            channels = [
                ChannelObject("rig", "Force", FORCE, {"wf_increment": 0.01, "unit_string": "N"}),
                ChannelObject("rig", "Way", (100 * WAY).astype("i2"), {"unit_string": "mm"}),
                ChannelObject("rig", "note", ["a", "b"], {}),
            ]
            writer.write_segment(channels)
    return [path.read_bytes()]


def _mdf(folder: Path) -> list[bytes]:
    from asammdf import MDF, Signal

    contents = []
    for compression in (0, 1, 2):
        path = folder / f"sound{compression}.mf4"
        with MDF(version="4.10") as file:
            way = Signal((100 * WAY).astype("i2"), TIME, name="Way", unit="mm", conversion={"a": 0.01, "b": 0.0})
            file.append([Signal(FORCE, TIME, name="Force", unit="N"), way])
            file.append([Signal(WAY[:9], TIME[:9], name="Heat", unit="°C")])
            file.save(path, overwrite=True, compression=compression)
        contents.append(path.read_bytes())
    return contents


def _xlsx(folder: Path) -> list[bytes]:
    from openpyxl import Workbook

    contents = []
    for heads in ([["t [s]", "x [mm]", "F [N]"]], [["bush 7"], [], ["t", "x", "F"], ["s", "mm", "N"]]):
        book, stream = Workbook(), io.BytesIO()
        for row in [*heads, *TABLE.tolist()]:
            book.active.append(row)
        book.create_sheet("about").append(["rig", "B", 7])
        book.save(stream)
        contents.append(stream.getvalue())
    return contents


def _petab(folder: Path) -> list[bytes]:
    heads = ["observableId", "simulationConditionId", "measurement", "time"]
    rows = [(name, "c", x, t) for name, values in (("x", WAY), ("F", FORCE)) for t, x in zip(TIME, values, strict=True)]
    return ["\n".join("\t".join(map(str, row)) for row in [heads, *rows]).encode()]


_WRITERS = {
    "csv": _csv,
    "hdf5": _hdf5,
    "json": _json,
    "lvm": _lvm,
    "mat": _mat,
    "mdf": _mdf,
    "npz": _npz,
    "petab": _petab,
    "rpc": _rpc,
    "tdms": _tdms,
    "tydex": _tydex,
    "xlsx": _xlsx,
}
WORDS = tuple(_WRITERS)
