"""The measured sets: what lies in each folder, and how it becomes runs."""

from __future__ import annotations

from collections.abc import Iterator

from real.sets import Entry, MeasuredSet, columns


def _bouc_wen() -> Iterator[Entry]:
    parts = {"train.h5": ("multisine", [8192, 12288, 24576, 28672], 2048), "test.h5": ("multisine", [1, 4097], 2048)}
    # the force comes again every 8192 samples: after two periods the noise of the displacement is another one
    again = {"train_3": "train_1", "train_4": "train_2"}
    for file, (group, starts, length) in parts.items():
        for number, start in enumerate(starts):
            name = f"{file.removesuffix('.h5')}_{number + 1}"
            yield {
                "name": name,
                "file": file,
                "kind": "random",
                "rows": [start, start + length - 1],
                "channels": columns(("y", "m"), ("u", "N")),
                "file_options": {"group": group},
                **({"repeats": again[name]} if name in again else {}),
            }
    for number in range(6):
        start = 10001 + 24000 * number
        yield {
            "name": f"sweep_{number + 1}",
            "file": "test.h5",
            "kind": "sweep",
            "rows": [start, start + 2999],
            "channels": columns(("y", "m"), ("u", "N")),
            "file_options": {"group": "sinesweep"},
        }


def _brfd() -> Iterator[Entry]:
    for frequency, amplitudes in ((0.5, (0.5, 1, 1.5)), (1, (0.5, 1, 1.5)), (2, (0.5,))):
        for inches in amplitudes:
            yield {
                "name": f"{frequency}Hz_{inches}in",
                "file": f"{frequency}Hz30lbtension{inches}amplitude.json",
                "settings": {"frequency": f"{frequency} Hz", "amplitude": f"{25.4 * inches} mm"},
            }


def _friction_rig() -> Iterator[Entry]:
    for number in range(10):
        start = 3150 + 3200 * number
        yield {
            "name": f"cycles_{4 * number + 1}",
            "file": "test_data_2.txt",
            "rows": [start, start + 1599],
            **({"repeats": f"cycles_{4 * number - 3}"} if number % 2 else {}),
        }


HDRB_BLOCKS = ((1, 931, 38), (6518, 931, 76), (13035, 931, 152), (19552, 974, 230))  # first row, rows a cycle, 0.1 mm


def _hdrb() -> Iterator[Entry]:
    for row, cycle, amplitude in HDRB_BLOCKS:
        for name, first, last in (("virgin", 0, 3), ("later", 3, 7)):
            yield _hdrb_run(f"{amplitude / 10:g}cm_{name}", row, cycle, (first, last), amplitude)


def _hdrb_settled() -> Iterator[Entry]:
    for row, cycle, amplitude in HDRB_BLOCKS:
        first = f"{amplitude / 10:g}cm_4_5"
        yield _hdrb_run(first, row, cycle, (3, 5), amplitude)
        yield {**_hdrb_run(f"{amplitude / 10:g}cm_6_7", row, cycle, (5, 7), amplitude), "repeats": first}


def _hdrb_run(name: str, row: int, cycle: int, cycles: tuple[int, int], amplitude: float) -> Entry:
    return {
        "name": name,
        "file": "Test.mat",
        "rows": [row + cycle * cycles[0], row + cycle * cycles[1] - 1],
        "settings": {"amplitude": f"{amplitude} mm"},
    }


def _labcontrol_off() -> Iterator[Entry]:
    yield from (_labcontrol(f"off_{number}", f"ensaio{number}.1.mat", 0) for number in range(1, 11))


def _labcontrol_all() -> Iterator[Entry]:
    yield from _labcontrol_off()
    yield from (_labcontrol(f"on_{number}", f"ensaio{number}.2.2.mat", 1) for number in range(1, 11))


def _labcontrol(name: str, file: str, energised: int) -> Entry:
    return {"name": name, "file": file, "settings": {"energised": energised}}


UTFSM_RECORDS = {  # seconds of one run, and where a second one begins
    "2mm5Hz": (2.2, None),
    "5mm3Hz": (2.0, 2.0),
    "10mm1Hz": (5.0, 5.0),
    "25mm0x5Hz": (8.0, 8.0),
    "25mm0x25Hz": (10.0, 12.0),
    "25mm0x1Hz": (20.0, None),
}


def _utfsm_off() -> Iterator[Entry]:
    for record, (length, second) in UTFSM_RECORDS.items():
        yield _utfsm(record, "0", 0.0, length)
        if second is not None:
            yield {**_utfsm(record, "0", second, length), "name": f"{record}_0A_again", "repeats": f"{record}_0A"}


def _utfsm_all() -> Iterator[Entry]:
    few = ("5mm3Hz", "10mm1Hz", "25mm0x25Hz")
    for current in ("0", "0x25", "0x5", "0x75", "1"):
        for record, (length, _) in UTFSM_RECORDS.items():
            if current in ("0", "1") or record in few:
                yield _utfsm(record, current, 0.0, length)


def _utfsm(record: str, current: str, start: float, length: float) -> Entry:
    millimetres, hertz = record.removesuffix("Hz").replace("x", ".").split("mm")
    fast = record in ("5mm3Hz", "10mm1Hz")
    return {
        "name": f"{record}_{current}A",
        "file": f"preprocessed/{record}{current}A.txt",
        "start": f"{start} s",
        "stop": f"{start + length} s",
        "settings": {
            "amplitude": f"{millimetres} mm",
            "frequency": f"{hertz} Hz",
            "current": current.replace("x", ".") + " A",
        },
        **({"decimate": 5} if fast else {}),
    }


def _seal(ring: str) -> Iterator[Entry]:
    for pressure in (1, 3, 5, 7):
        for number, original in ((2, None), (3, 2), (6, None), (7, 6)):
            entry = {
                "name": f"{pressure}bar_{number}",
                "file": f"{ring}257_{pressure}bar-{number}.csv",
                "settings": {"pressure": f"{pressure} bar"},
            }
            yield {**entry, "repeats": f"{pressure}bar_{original}"} if original else entry


def _o_ring() -> Iterator[Entry]:
    yield from _seal("O-ring")


def _x_ring() -> Iterator[Entry]:
    yield from _seal("X-ring")


def _catalogue() -> Iterator[MeasuredSet]:
    yield MeasuredSet(
        name="bouc_wen",
        folder="bouc_wen_benchmark",
        title="Hysteretic oscillator",
        cut="Pieces of two random excitations, from the steady part, and of a sweep from 20 to 50 Hz.",
        defaults={"sampling": "750 Hz"},
        runs=_bouc_wen,
        known_faults=("moving_mass",),
    )
    yield MeasuredSet(
        name="brfd",
        folder="friction_damper_brfd",
        title="Banded rotary friction damper",
        cut="Every test of one frequency and amplitude is a run, with its growing and fading cycles.",
        defaults={
            "kind": "harmonic",
            "sampling": "1024 Hz",
            "decimate": 2,
            "channels": columns((2, "in"), (3, "kip")),
        },
        runs=_brfd,
    )
    yield MeasuredSet(
        name="friction_rig_jl",
        folder="friction_rig_jl",
        title="Friction tester",
        cut="Two cycles a run, from all over the record; every other run is declared a repeat of the one before.",
        defaults={
            "kind": "transient",
            "channels": {
                "time": {"column": 1, "unit": "s"},
                "displacement": {"column": 3, "unit": "mm", "offset": "-110 mm"},
                "force": {"column": 4, "unit": "uN", "sign": -1},
            },
            "decimate": 2,
        },
        runs=_friction_rig,
        seeds=(0, 1, 8),
    )
    later = "At each amplitude cycles 4 and 5, repeated by cycles 6 and 7."
    first = "At each amplitude the first three cycles are a run, the other four another one."
    for name, runs, which, cut, seeds in (
        ("hdrb", _hdrb, "", first, (0, 1, 4)),
        ("hdrb_settled", _hdrb_settled, ", settled", later, (0, 1, 5)),
    ):
        yield MeasuredSet(
            name=name,
            folder="hdrb_bearing",
            title=f"High-damping rubber bearing{which}",
            cut=cut,
            defaults={
                "kind": "harmonic",
                "sampling": "465.5 Hz",
                "decimate": 4,
                "channels": {
                    "displacement": {"column": "d", "unit": "cm"},
                    "force": {"column": "f", "unit": "kN", "gain": 9.80665},
                },
            },
            runs=runs,
            seeds=seeds,
        )
    for name, runs, which, cut in (
        ("labcontrol_off", _labcontrol_off, "off", "Every test without voltage is a run."),
        ("labcontrol_all", _labcontrol_all, "off and energised", "Every test is a run; energised or not is a setting."),
    ):
        yield MeasuredSet(
            name=name,
            folder="mr_damper_labcontrol",
            title=f"Magnetorheological damper on a crank, {which}",
            cut=cut,
            defaults={
                "kind": "harmonic",
                "sampling": "100 Hz",
                "start": "1 s",
                "stop": "12 s",
                "channels": columns(("dist", "mm"), ("forc", "N")),
            },
            runs=runs,
            known_faults=("offset",),
        )
    for name, runs, which, cut in (
        ("utfsm_off", _utfsm_off, "no current", "Pieces of every sine; a second piece repeats the first."),
        ("utfsm_all", _utfsm_all, "all currents", "A piece of each sine; the current is a setting."),
    ):
        yield MeasuredSet(
            name=name,
            folder="mr_damper_utfsm",
            title=f"Magnetorheological damper in a press, {which}",
            cut=cut,
            defaults={
                "kind": "harmonic",
                "channels": columns((2, "mm"), (4, "N"), time={"column": 1, "unit": "s"}),
            },
            runs=runs,
        )
    for name, runs, seeds in (("o_ring", _o_ring, (0, 1, 4)), ("x_ring", _x_ring, (0, 1, 2))):
        yield MeasuredSet(
            name=name,
            folder="seal_friction_pneumatic",
            title=f"{name[0].upper()}-ring seal of a pneumatic cylinder",
            cut="A cycle forth and back is a run, two pairs of them at each pressure, which is a setting.",
            defaults={
                "kind": "transient",
                "channels": columns((2, "mm"), (3, "N"), time={"column": 1, "unit": "s"}),
            },
            runs=runs,
            seeds=seeds,
        )


SETS = {one.name: one for one in _catalogue()}
