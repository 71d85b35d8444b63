"""LabVIEW measurement files as LabVIEW writes them: one or several segments, one, several or no clocks."""

import numpy as np
import pytest

from dashpot.contract.reader import ReadingError
from dashpot_formats.lvm import Lvm

HEADING = """LabVIEW Measurement\t
Writer_Version\t2
Reader_Version\t2
Separator\tTab
Decimal_Separator\t{decimal}
Multi_Headings\t{multi}
X_Columns\t{clocks}
Time_Pref\tRelative
Operator\trig
Description\tbush, radial
Date\t2024/02/28
Time\t15:53:23{decimal}1234567
***End_of_Header***\t
\t
"""
SEGMENT = """Channels\t2\t\t
Samples\t{count}\t{count}\t
Date\t2024/02/28\t2024/02/28\t
Time\t{time}\t{time}\t
Y_Unit_Label\tNewton\tmm\t
X_Dimension\tTime\tTime\t
X0\t{first}\t{first}\t
Delta_X\t{step}\t{step}\t
***End_of_Header***\t\t\t
{names}
{rows}

"""
FORCE, WAY = 1.5 * np.sin(np.arange(40) / 5), np.arange(40) * 0.25
ONE, MANY = "X_Value\tForce\tWay\tComment", "X_Value\tForce\tX_Value\tWay\tComment"


def segment(part=slice(None), clocks="One", decimal=".", time="15:53:23.2", first=0.0, step=0.01, names=""):
    rows = []
    for number, (force, way) in enumerate(zip(FORCE[part].tolist(), WAY[part].tolist(), strict=True)):
        now = f"{first + step * number:.6f}"
        cells = {
            "One": [now, f"{force!r}", f"{way!r}", "start" if number == 0 else ""],
            "Multi": [now, f"{force!r}", now, f"{way!r}", ""],
            "No": ["", f"{force!r}", f"{way!r}", ""],
        }[clocks]
        rows.append("\t".join(cells))
    text = SEGMENT.format(
        count=len(rows),
        time=time,
        first=f"{first:.6E}",
        step=f"{step:.6f}",
        rows="\n".join(rows),
        names=names or (MANY if clocks == "Multi" else ONE),
    )
    return text.replace(".", decimal)


def written(tmp_path, *parts, clocks="One", decimal="."):
    path = tmp_path / "a.lvm"
    text = HEADING.format(decimal=decimal, clocks=clocks, multi="Yes" if len(parts) > 1 else "No") + "".join(parts)
    path.write_bytes(text.replace("\n", "\r\n").encode())
    return path


@pytest.mark.parametrize("decimal", [".", ","])
@pytest.mark.parametrize("clocks", ["One", "Multi", "No"])
def test_one_segment_with_one_several_or_no_clocks(tmp_path, clocks, decimal):
    path = written(tmp_path, segment(clocks=clocks, decimal=decimal), clocks=clocks, decimal=decimal)
    table = Lvm().read(path, {})
    assert list(table.columns) == ["X_Value", "Force", "Way"]
    assert np.array_equal(table.columns["Force"].astype(float), FORCE)
    assert np.array_equal(table.columns["Way"].astype(float), WAY)
    assert np.allclose(table.columns["X_Value"], 0.01 * np.arange(40))
    assert dict(table.units) == {"X_Value": "s", "Force": "N", "Way": "mm"}


def test_a_second_clock_with_a_damaged_time_stays_beside_the_first(tmp_path):
    path = written(tmp_path, segment(clocks="Multi").replace("\t0.170000\t", "\t0,1?000\t"), clocks="Multi")
    table = Lvm().read(path, {})
    assert list(table.columns) == ["X_Value", "Force", "Way", "X_Value 2"]
    assert table.columns["X_Value 2"][17] == "0,1?000"
    assert np.allclose(table.columns["X_Value"], 0.01 * np.arange(40))


def test_a_second_clock_that_differs_in_one_segment_only_is_whole(tmp_path):
    first, second = (segment(part, clocks="Multi") for part in (slice(20), slice(20, None)))
    path = written(tmp_path, first, second.replace("\t0.050000\t", "\t0.052000\t"), clocks="Multi")
    table = Lvm().read(path, {})
    expected = np.tile(0.01 * np.arange(20), 2)
    expected[25] = 0.052
    assert np.allclose(table.columns["X_Value 2"].astype(float), expected)


def test_lines_are_those_of_the_file(tmp_path):
    path = written(tmp_path, segment())
    table = Lvm().read(path, {})
    first = path.read_text().splitlines()[table.lines[0] - 1]
    assert first.startswith("0.000000\t")


def test_segments_of_one_recording_go_on_in_time(tmp_path):
    """Written in blocks of 25 samples, each from zero on; the dates say that they follow each other."""
    parts = [segment(slice(0, 25)), segment(slice(25, 40), time="15:53:23.45")]
    table = Lvm().read(written(tmp_path, *parts), {})
    assert np.allclose(table.columns["X_Value"], 0.01 * np.arange(40))
    assert np.array_equal(table.columns["Force"].astype(float), FORCE)


def test_segments_recorded_later_start_their_own_time(tmp_path):
    parts = [segment(slice(0, 25)), segment(slice(25, 40), time="15:59:00.0")]
    path = written(tmp_path, *parts)
    table = Lvm().read(path, {})
    assert np.allclose(table.columns["X_Value"], np.r_[0.01 * np.arange(25), 0.01 * np.arange(15)])
    second = Lvm().read(path, {"segment": 2})
    assert np.array_equal(second.columns["Way"].astype(float), WAY[25:])
    with pytest.raises(ReadingError, match="it has 2 segments, there is no segment 3"):
        Lvm().read(path, {"segment": 3})


def test_other_channels_are_another_measurement(tmp_path):
    parts = [segment(), segment(names="X_Value\tTemp\tHumidity\tComment")]
    path = written(tmp_path, *parts)
    assert list(Lvm().read(path, {}).columns) == ["X_Value", "Force", "Way"]
    assert list(Lvm().read(path, {"segment": 2}).columns) == ["X_Value", "Temp", "Humidity"]


def test_a_file_without_a_heading_is_a_text_table(tmp_path):
    path = tmp_path / "a.lvm"
    path.write_text("\n".join(f"{t:.3f}\t{f!r}" for t, f in enumerate(FORCE.tolist())))
    assert np.array_equal(Lvm().read(path, {}).columns["2"], FORCE)


PLAIN = HEADING.format(decimal=".", clocks="One", multi="No")


@pytest.mark.parametrize(
    "text, message",
    [
        ("LabVIEW Measurement\t\nSeparator\tTab\n", "expected a line"),
        (PLAIN, "no segment with channels"),
        (PLAIN + "Channels\t1\n***End_of_Header***\t\n", "names of the columns"),
        (PLAIN + "Channels\t1\n***End_of_Header***\t\nX_Value\tF\n", "no rows"),
    ],
)
def test_broken_files_say_what_is_missing(tmp_path, text, message):
    path = tmp_path / "a.lvm"
    path.write_text(text)
    with pytest.raises(ReadingError, match=message):
        Lvm().read(path, {})
