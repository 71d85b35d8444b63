"""What a C program gets."""

from __future__ import annotations

import subprocess
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from unit.exports.mounts import SAMPLES, mount, sine

from dashpot import load_registry
from dashpot.kernel.network import compile_network
from dashpot.text.problem import InputError

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


def export(network, folder: Path) -> None:
    for name, content in load_registry().exports["c"]().files(network).items():
        (folder / name).write_bytes(content)


def test_a_program_with_sanitizers_steps_goes_back_and_sets_numbers(tmp_path):
    export(mount(), tmp_path)
    (tmp_path / "main.c").write_bytes((Path(__file__).parent / "main.c").read_bytes())
    subprocess.run(["cc", *STRICT, "-o", "run", "main.c", "mount.c", "-lm"], cwd=tmp_path, check=True)
    done = subprocess.run(
        [tmp_path / "run"], check=True, capture_output=True, text=True, env={"ASAN_OPTIONS": "detect_leaks=0"}
    )
    *shown, stiffer = np.array(done.stdout.split(), dtype=float)
    network = compile_network(mount())
    expected = network.simulate(network.prepare(sine()))
    assert np.max(np.abs(shown[:SAMPLES] - expected)) <= 1e-12 * np.max(np.abs(expected))
    assert np.array_equal(shown[SAMPLES:], shown[200:SAMPLES])
    values = network.start.copy()
    values[network.paths.index("rubber.stiffness")] = 3e5
    place = sine().displacement[100]
    # at rest where the record begins: the spring alone, and what friction and relaxation make of no motion at all
    assert stiffer == pytest.approx(3e5 * place, rel=1e-12)


def test_the_source_allocates_nothing_and_needs_mathematics_alone(tmp_path):
    export(mount(), tmp_path)
    text = (tmp_path / "mount.c").read_text()
    assert [line for line in text.splitlines() if line.startswith("#include")] == [
        '#include "mount.h"',
        "#include <math.h>",
    ]
    assert "alloc" not in text and '{"rubber.stiffness", "N/m", 220000.0}' in text


def test_a_name_that_c_does_not_take_is_changed(tmp_path):
    files = load_registry().exports["c"]().files(replace(mount(), name="3rd mount*/"))
    assert sorted(files) == ["network_3rd_mount__.c", "network_3rd_mount__.h"]
    assert b"3rd mount* /" in files["network_3rd_mount__.h"]


def test_a_text_of_the_file_does_not_end_its_comment(tmp_path):
    network = replace(mount(), source="*\\\n/ int injected; *\\\n/")
    export(network, tmp_path)
    (tmp_path / "it.c").write_text('#include "mount.h"\nint injected(void);\nint injected(void) { return 1; }\n')
    subprocess.run(["cc", "-std=c99", "-Wall", "-Wextra", "-Werror", "-c", "it.c"], cwd=tmp_path, check=True)


def test_a_curve_without_numbers_is_refused_by_name():
    import dashpot as dp

    with pytest.raises(InputError, match="the curve 'stiffness.stiffness' is to be taken from data"):
        load_registry().exports["c"]().files(dp.load("tire_model_5"))


@pytest.mark.parametrize("name", ["system", "double", "exp"])
def test_a_name_of_the_language_or_its_library_gives_a_source_that_compiles(name, tmp_path):
    export(replace(mount(), name=name), tmp_path)
    subprocess.run(["cc", "-std=c99", "-Wall", "-Wextra", "-Werror", "-c", f"{name}.c"], cwd=tmp_path, check=True)
