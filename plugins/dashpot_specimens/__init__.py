"""The built-in virtual specimens; the name of the file is the word a user gives.

- `test_tire`  a tire on a single-axis rig
- `tire_laws`  what the tire answers to its deflection
- `tire_path`  what the rig does to it
- `rig_log`    what the rig writes down
- `test_mount` a hydraulic engine mount on such a rig
- `mount_laws` what the mount answers to its deflection
- `test_car`   an axle on two platforms, and its tire
- `car_laws`   what the car answers to its platforms
- `car_path`   what the rigs do to it
"""

from __future__ import annotations

import pluggy

hookimpl = pluggy.HookimplMarker("dashpot")


@hookimpl
def dashpot_specimens() -> list[type]:
    """Every specimen of this package."""
    from dashpot_specimens.test_car import CarOnRig
    from dashpot_specimens.test_mount import MountOnRig
    from dashpot_specimens.test_tire import TireOnRig

    return [TireOnRig, MountOnRig, CarOnRig]
