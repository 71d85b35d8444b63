"""``dashpot warm``: compile networks before they are needed."""

from __future__ import annotations

import click

from dashpot.cli import complete
from dashpot.cli.session import Session
from dashpot.cli.switches import Switches, switches

ENDINGS = (".o", ".nbc")  # of machine code that LLVM and numba keep


@click.command("warm")
@click.argument("models", nargs=-1, metavar="[MODEL]...", shell_complete=complete.networks)
@switches("json", "quiet", "backend")
def verb(models: tuple[str, ...], switches: Switches) -> None:
    """Compile networks ahead.

    The first simulation or fit with them then starts at once. Without MODEL all shipped ones. What is compiled already
    is left as it is.

    \b
    Example:
      dashpot warm
      dashpot warm my_network.yaml
    """
    from dashpot.kernel.ahead import compile_ahead
    from dashpot.kernel.cache import cache_folder
    from dashpot.model.shipped import shipped_networks

    session = Session(switches)
    before, names = compiled_files(), models or tuple(shipped_networks())
    with session.watch("compiling") as progress:
        for number, model in enumerate(names):
            progress(model, number / len(names))
            compile_ahead(session.network(model))
    new = len(compiled_files() - before)
    content = {"format": "dashpot-warm/1", "networks": list(names), "new": new, "folder": str(cache_folder())}
    many = f"{len(names)} network{'s' * (len(names) != 1)}"
    text = f"{many} ready: {new} of their kernels compiled now, the others known" if new else f"{many} ready already"
    session.talk.result(f"{text}; kept in {cache_folder()}", content)


def compiled_files() -> set[str]:
    """The names of what is compiled."""
    from dashpot.kernel.cache import cache_folder

    folder = cache_folder() / "kernels"
    return {path.name for ending in ENDINGS for path in folder.rglob(f"*{ending}")}
