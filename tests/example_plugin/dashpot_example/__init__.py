"""An example of a plugin: one element and one optimizer."""

from dashpot import hookimpl


@hookimpl
def dashpot_elements():
    """Laws of this package."""
    from dashpot_example.soft_slider import SoftSlider

    return [SoftSlider]


@hookimpl
def dashpot_optimizers():
    """Methods of this package."""
    from dashpot_example.random_search import RandomSearch

    return [RandomSearch]
