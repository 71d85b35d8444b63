"""The unsprung masses of random cars: `python tests/unsprung_mass/run.py --cars 30`.

Every car is drawn anew (mass, tire, shock absorber, friction; every other one has rubber top mounts) and measured on
the virtual rigs by the laws of `test_car`, none of which is an element of dashpot. The shipped study identifies it from
the files alone; then the true mass is compared. Printed are each car as it comes, and at the end how far off the masses
are and how often the 95 % intervals hold the truth.
"""

from __future__ import annotations

import argparse
import json
import secrets
import tempfile
import traceback
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor, as_completed
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import numpy as np

STUDY = "unsprung_mass"
EVERY, SWEEP = 20, 10.0  # 1 kHz; half as long as the sweeps of the shipped specimen


def identify_car(seed: int, number: int) -> dict[str, Any]:
    """The true mass of one car, and what the study finds, with every model."""
    from dashpot import load_registry
    from dashpot.data.dataset import read_dataset
    from dashpot.fit.study.reading import find_study, read_study
    from dashpot.fit.study.run import run_study
    from dashpot.study.study import study_content
    from dashpot_specimens.test_car import measure_car

    registry = load_registry()
    car = drawn_car(seed, number)
    with tempfile.TemporaryDirectory() as folder:
        path = measure_car(car, Path(folder), seed, EVERY, SWEEP)
        dataset = read_dataset(path, {word: reader() for word, reader in registry.formats.items()})
        study = read_study(find_study(STUDY), registry)
        content = study_content(run_study(study, dataset, registry=registry))
    return {
        "number": number,
        "truth": car.wheel_mass,
        "mount": car.mount_stiffness,
        "answer": content["masses"][0],
        "models": [
            {"name": model["name"], "error": model["rmse"]["train"], **mass}
            for model in content["models"]
            for mass in model["masses"]
        ],
        "tire": content["models"][0]["rmse"]["train"],
        "noise_floor": content["noise_floor"],
        "masses_without_tire": [model["masses_without_tire"] for model in content["models"][1:]],
    }


def drawn_car(seed: int, number: int) -> Any:
    """A car; one whose wheels leave the platforms is drawn again, as its test would be run at a smaller amplitude."""
    from dashpot_specimens import car_path
    from dashpot_specimens.car_laws import drive_car
    from dashpot_specimens.test_car import ADDED_MASSES, AXLE_AMPLITUDE, random_car

    rng = np.random.default_rng([seed, number])
    path = car_path.sweep(AXLE_AMPLITUDE, 5.0, 20.0, SWEEP)
    while True:
        car = random_car(rng, mount=number % 2 == 1)
        if all(drive_car(car, np.array([path, path]), added)["force"].min() > 0.0 for added in ADDED_MASSES):
            return car


def answer(car: dict[str, Any]) -> dict[str, Any]:
    """The mass that the study answers with."""
    return car["answer"]


def lines(cars: list[dict[str, Any]]) -> Iterator[str]:
    """The table and the shares."""
    yield " car  mount N/mm  true kg  found kg  95 % interval       off %  error N  model"
    for car in sorted(cars, key=lambda car: car["number"]):
        yield line(car)
    for what, chosen in (
        ("bolted", [c for c in cars if np.isinf(c["mount"])]),
        ("top mount", [c for c in cars if np.isfinite(c["mount"])]),
        ("all", cars),
    ):
        if chosen:
            off = np.array([100.0 * (answer(car)["value"] / car["truth"] - 1.0) for car in chosen])
            held = sum(holds(car) for car in chosen)
            yield (
                f"{what}: {len(chosen)} cars, {off.mean():+.2f} % in the mean, {off.std():.2f} % scatter, "
                f"largest {np.abs(off).max():.2f} %, within 0.4 %: {np.sum(np.abs(off) <= 0.4)}; "
                f"the interval holds the truth in {held} = {100.0 * held / len(chosen):.0f} %"
            )


def line(car: dict[str, Any]) -> str:
    """One car of the table."""
    found = answer(car)
    low, high = found["interval"]
    off = 100.0 * (found["value"] / car["truth"] - 1.0)
    mark = "" if holds(car) else "  outside"
    return (
        f"{car['number']:4d}  {1e-3 * car['mount']:10.0f}  {car['truth']:7.3f}  {found['value']:8.3f}  "
        f"{low:7.3f} to {high:7.3f}  {off:+6.2f}  {found['error']:7.2f}  {found['model']}{mark}"
    )


def kept(seed: int, cars: list[dict[str, Any]]) -> dict[str, Any]:
    """What is worth keeping of a run: each car's truth and the study's answer."""
    keys = ("value", "interval", "error", "model")
    rows = [
        {
            "number": car["number"],
            "truth": car["truth"],
            "mount": car["mount"] if np.isfinite(car["mount"]) else None,
            **{key: answer(car)[key] for key in keys},
        }
        for car in cars
    ]
    return {"seed": seed, "cars": sorted(rows, key=lambda row: row["number"])}


def earlier(file: Path | None, seed: int, numbers: range) -> list[dict[str, Any]]:
    """The cars of these numbers that an earlier call has written into a file."""
    if file is None or not file.exists():
        return []
    found = [json.loads(line) for line in file.read_text().splitlines()]
    return list({car["number"]: car for car in found if car["seed"] == seed and car["number"] in numbers}.values())


def holds(car: dict[str, Any]) -> bool:
    """Whether the interval holds the true mass."""
    low, high = answer(car)["interval"]
    return bool(low <= car["truth"] <= high)


def main() -> None:
    """Draw, identify and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cars", type=int, default=30)
    parser.add_argument("--first", type=int, default=0, help="number of the first car")
    parser.add_argument("--seed", type=int, default=None, help="drawn where it is not given, and printed")
    parser.add_argument("--jobs", type=int, default=1, help="cars at the same time")
    parser.add_argument("--output", type=Path, help="a file for every car's result, as lines; cars in it are done")
    parser.add_argument("--keep", type=Path, help="a JSON file for the true and the identified masses")
    asked = parser.parse_args()
    seed = secrets.randbelow(2**31) if asked.seed is None else asked.seed
    print(f"seed {seed}", flush=True)
    numbers = range(asked.first, asked.first + asked.cars)
    cars = earlier(asked.output, seed, numbers)
    left = sorted(set(numbers) - {car["number"] for car in cars})
    with ProcessPoolExecutor(asked.jobs, mp_context=get_context("spawn")) as pool:
        waiting = [pool.submit(identify_car, seed, number) for number in left]
        for each in as_completed(waiting):
            if each.exception():
                print(*traceback.format_exception(each.exception()), flush=True)
                continue
            cars.append(each.result())
            print(line(cars[-1]), flush=True)
            if asked.output:
                with asked.output.open("a") as stream:
                    stream.write(json.dumps({"seed": seed, **cars[-1]}) + "\n")
    print(*lines(cars), sep="\n")
    if asked.keep:
        asked.keep.write_text(json.dumps(kept(seed, cars), indent=1) + "\n")
    if len(cars) < asked.cars:
        raise SystemExit(f"{asked.cars - len(cars)} cars failed, see above")


if __name__ == "__main__":
    main()
