"""The door for plugins: every hook on one page, the base class of each kind of thing, and the registry of what came in.

``hooks``      the hooks a plugin may implement, and ``hookimpl`` to mark them
``optimizer`` ``reader`` ``cause`` ``specimen``   the base classes (``Element`` is in ``dashpot.model.element``)
``origin``     where a thing comes from, and what was wrong with a plugin
``loading``    from installed entry points to things, with faulty plugins named and set aside
``registry``   all things by kind and word
``options``    constructor arguments given as text
"""
