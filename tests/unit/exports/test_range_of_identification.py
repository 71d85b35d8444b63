"""Exports raise a flag where the motion leaves the range in which the numbers were identified."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from unit.exports.mounts import MOUNT

from dashpot import declare, load_registry

RANGE = """
identified:
  data: 0123456789abcdef
  range: {displacement: [5 mm, 15 mm], speed: [0 m/s, 300 mm/s], amplitude: [1 mm, 4 mm], preload: [8 mm, 12 mm],
          frequency: [1 Hz, 15 Hz]}
"""
MAIN = """\
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "mount.h"

static mount_network network;
static double kept[MOUNT_STATE];

int main(int count, char **words)
{
    const double preload = atof(words[1]), amplitude = atof(words[2]), rate = 6.283185307179586 * atof(words[3]);
    (void)count;
    mount_init(&network, 1e-2);
    mount_get_state(&network, kept);
    for (int k = 0; k < 3000; ++k) {
        const double phase = rate * 1e-3 * k;
        mount_step(&network, preload + amplitude * sin(phase), rate * amplitude * cos(phase), 1e-3);
    }
    printf("%d", mount_outside(&network));
    mount_set_state(&network, kept);
    printf(" %d", mount_outside(&network));
    return mount_status(&network);
}
"""
STRICT = (
    "-std=c99",
    "-O1",
    "-g",
    "-Wall",
    "-Wextra",
    "-Werror",
    "-pedantic",
    "-fsanitize=address,undefined",
    "-fno-sanitize-recover=all",
)


@pytest.fixture(scope="module")
def program(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("range")
    for name, content in load_registry().exports["c"]().files(declare(MOUNT + RANGE)).items():
        (folder / name).write_bytes(content)
    (folder / "main.c").write_text(MAIN)
    subprocess.run(["cc", *STRICT, "-o", "run", "main.c", "mount.c", "-lm"], cwd=folder, check=True)
    return folder


@pytest.mark.parametrize(
    ("motion", "flag"),
    [
        (("0.010", "0.002", "5"), 0),
        (("0.010", "0.0005", "5"), 0),
        (("0.010", "0.0049", "2"), 4),
        (("0.010", "0.006", "2"), 1 + 4),
        (("0.0135", "0.0012", "5"), 8),
        (("0.010", "0.0012", "20"), 16),
        (("0.010", "0.004", "14"), 2),
        (("0.010", "0.003", "0.4"), 16),
        (("0.002", "0.001", "5"), 1 + 8),
    ],
)
def test_each_quantity_raises_its_flag(program, motion, flag):
    done = subprocess.run(
        [program / "run", *motion], check=True, capture_output=True, text=True, env={"ASAN_OPTIONS": "detect_leaks=0"}
    )
    assert done.stdout == f"{flag} 0"


def test_the_head_tells_the_range_and_where_the_numbers_came_from(program):
    head = (program / "mount.h").read_text()
    assert "data 0123456789abcdef" in head and "speed 0 mm/s to 300 mm/s" in head and "frequency 1 Hz to 15 Hz" in head


def test_without_a_range_there_is_no_flag():
    [_, source] = [
        text.decode() for _, text in sorted(load_registry().exports["c"]().files(declare(MOUNT)).items(), reverse=True)
    ]
    assert "watch(" not in source


@pytest.mark.parametrize("word", ["fmu", "fmu2"])
def test_a_unit_has_the_flag_as_an_output_and_the_range_as_annotations(word, tmp_path):
    fmpy = pytest.importorskip("fmpy")
    from fmpy.validation import validate_fmu

    [(name, content)] = load_registry().exports[word]().files(declare(MOUNT + RANGE)).items()
    (tmp_path / name).write_bytes(content)
    assert validate_fmu(str(tmp_path / name)) == []
    shutil.unpack_archive(tmp_path / name, tmp_path / "unit", "zip")
    about = (tmp_path / "unit" / "modelDescription.xml").read_text()
    assert "frequency" in about and ">1.0 15.0</" in about
    time = np.arange(600) * 1e-3
    for amplitude, flag in ((2e-3, 0), (6e-3, 5)):
        rate = 2.0 * np.pi * 5.0
        given = np.rec.fromarrays(
            [time, 10e-3 + amplitude * np.sin(rate * time), np.minimum(amplitude, 2e-3) * rate * np.cos(rate * time)],
            names="time,displacement,velocity",
        )
        found = fmpy.simulate_fmu(
            str(tmp_path / name),
            input=given,
            output=["outside"],
            step_size=1e-3,
            output_interval=1e-3,
            stop_time=0.599,
            start_values={"displacement": 10e-3},
        )
        assert found["outside"][-1] == flag
