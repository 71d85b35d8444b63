"""RPC III time histories, written here byte by byte, are read in every layout that the format knows."""

from __future__ import annotations

import struct

import numpy as np
import pytest

from dashpot.contract.reader import ReadingError
from dashpot_formats.rpc import Rpc

COUNTS = np.array([[10 * channel + sample for sample in range(24)] for channel in range(3)]) * 7 - 100
SCALES = (0.5, 0.25, 2.0)


def header(**changes):
    """Keywords and values of a file with three channels of 24 samples; a value None leaves a keyword out."""
    values = {
        "FORMAT": "BINARY_IEEE_LITTLE_END",
        "NUM_HEADER_BLOCKS": None,
        "NUM_PARAMS": None,
        "FILE_TYPE": "TIME_HISTORY",
        "TIME_TYPE": "RESPONSE",
        "DELTA_T": "4.882812E-03",
        "DATA_TYPE": "SHORT_INTEGER",
        "CHANNELS": 3,
        "PTS_PER_FRAME": 4,
        "PTS_PER_GROUP": 8,
        "FRAMES": 6,
        "INT_FULL_SCALE": 32752,
    }
    for number, (name, unit) in enumerate((("Displacement", "mm"), ("Force", "kN"), ("", "-")), 1):
        values |= {
            f"DESC.CHAN_{number}": name,
            f"UNITS.CHAN_{number}": unit,
            f"SCALE.CHAN_{number}": SCALES[number - 1],
        }
    values |= {key.replace("__", "."): value for key, value in changes.items()}
    blocks = -(-sum(value is not None for value in values.values()) // 4) + 1
    counted = {"NUM_HEADER_BLOCKS": blocks, "NUM_PARAMS": sum(value is not None for value in values.values()) + 2}
    values |= {key: value for key, value in counted.items() if key not in changes}
    records = [
        struct.pack("32s96s", key.encode(), str(value).encode()) for key, value in values.items() if value is not None
    ]
    return b"".join(records).ljust(512 * blocks, b"\0")


def data(counts, group, order="<", letter="h", fill=0):
    """The groups one behind the other, in each the points of the first channel, then of the second, and so on."""
    parts = []
    for start in range(0, counts.shape[1], group):
        for channel in counts[:, start : start + group]:
            points = [*channel, *[fill] * (group - len(channel))]
            parts.append(struct.pack(f"{order}{len(points)}{letter}", *points))
    return b"".join(parts)


def read(folder, content, **options):
    (folder / "a.rsp").write_bytes(content)
    return Rpc().read(folder / "a.rsp", options)


def numbers(table):
    return np.array(list(table.columns.values()))


@pytest.mark.parametrize("order", ["<", ">"])
@pytest.mark.parametrize(("frame", "group"), [(4, 8), (8, 8), (24, 24), (1, 1), (2, 12), (4, 16), (4, 20), (4, 32)])
def test_groups_of_any_size_in_either_byte_order(tmp_path, order, frame, group):
    word = {"<": "BINARY_IEEE_LITTLE_END", ">": "BINARY_IEEE_BIG_END"}[order]
    head = header(FORMAT=word, PTS_PER_FRAME=frame, PTS_PER_GROUP=group, FRAMES=24 // frame)
    table = read(tmp_path, head + data(COUNTS, group, order))
    assert np.array_equal(numbers(table), COUNTS * np.array(SCALES)[:, None])
    assert list(table.columns) == ["Displacement", "Force", "channel 3"]
    assert dict(table.units) == {"Displacement": "mm", "Force": "kN"}
    assert table.sampling == 204.8


@pytest.mark.parametrize("order", ["<", ">"])
def test_real_numbers_are_not_scaled(tmp_path, order):
    word = {"<": "BINARY", ">": "BINARY_IEEE_BIG_END"}[order]
    values = np.float32(COUNTS) * np.float32(0.3)
    table = read(tmp_path, header(FORMAT=word, DATA_TYPE="FLOATING_POINT") + data(values, 8, order, "f"))
    assert np.array_equal(numbers(table), values.astype(float))


def test_a_last_group_that_ends_with_its_samples(tmp_path):
    head = header(PTS_PER_GROUP=16)
    short = data(COUNTS[:, :16], 16) + data(COUNTS[:, 16:], 8)
    assert np.array_equal(numbers(read(tmp_path, head + short)), COUNTS * np.array(SCALES)[:, None])


def test_a_stated_number_of_samples_cuts_off_the_filling(tmp_path):
    table = read(tmp_path, header(SAMPLES=21) + data(COUNTS, 8))
    assert numbers(table).shape == (3, 21)


def test_a_name_that_comes_twice_gets_its_number(tmp_path):
    table = read(tmp_path, header(DESC__CHAN_1="Force") + data(COUNTS, 8))
    assert list(table.columns) == ["Force (channel 1)", "Force (channel 2)", "channel 3"]


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", "expected the keywords FORMAT, NUM_HEADER_BLOCKS, NUM_PARAMS"),
        (b"t;x;F\n1;2;3\n" * 100, "expected the keywords FORMAT"),
        (header()[:600], "it is cut short: expected a header of"),
        (header() + data(COUNTS, 8)[:-1], "it is cut short: expected 144 bytes behind its header, got"),
        (header(FORMAT="ASCII") + data(COUNTS, 8), "expected FORMAT as BINARY or"),
        (header(DATA_TYPE="DOUBLE") + data(COUNTS, 8), "expected DATA_TYPE as SHORT_INTEGER or"),
        (header(FILE_TYPE="MATRIX") + data(COUNTS, 8), "expected FILE_TYPE as TIME_HISTORY"),
        (header(CHANNELS=0) + data(COUNTS, 8), "expected CHANNELS as a whole number from 1"),
        (header(CHANNELS=10**9) + data(COUNTS, 8), "expected CHANNELS as a whole number from 1 to 4096"),
        (header(FRAMES=10**11) + data(COUNTS, 8), "it is cut short"),
        (header(FRAMES="six") + data(COUNTS, 8), "expected a number after FRAMES, got 'six'"),
        (header(PTS_PER_GROUP=10) + data(COUNTS, 8), "expected whole frames in a group"),
        (header(DELTA_T="0") + data(COUNTS, 8), "expected a number after DELTA_T"),
        (header(DELTA_T=None) + data(COUNTS, 8), "expected a number after DELTA_T, got ''"),
        (header(SCALE__CHAN_2=None) + data(COUNTS, 8), "expected a number after SCALE.CHAN_2"),
        (header(NUM_HEADER_BLOCKS="nan") + data(COUNTS, 8), "expected a number after NUM_HEADER_BLOCKS"),
    ],
)
def test_what_is_wrong_with_a_file_is_told(tmp_path, content, message):
    with pytest.raises(ReadingError) as caught:
        read(tmp_path, content)
    assert message in caught.value.message and caught.value.hint


def test_it_has_no_options(tmp_path):
    with pytest.raises(ReadingError, match="there is no file option 'order'"):
        read(tmp_path, header() + data(COUNTS, 8), order="big")
