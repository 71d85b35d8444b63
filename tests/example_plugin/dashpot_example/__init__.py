"""An example of a plugin: an element, an optimizer, a cause and a format."""

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


@hookimpl
def dashpot_causes():
    """Candidate causes of this package."""
    from dashpot_example.missing_slider import MissingSlider

    return [MissingSlider]


@hookimpl
def dashpot_formats():
    """Readers of this package."""
    from dashpot_example.blank_columns import BlankColumns

    return [BlankColumns]
