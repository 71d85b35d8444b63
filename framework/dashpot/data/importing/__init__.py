"""A first dataset file from measured files alone: what their names, units and numbers tell, and what they leave open.

- `roles`: which column is which channel; `pairs`: which two of them are displacement and force; `letters`: whether a
  letter is a name
- `units`: in which unit; `timing`: the clock; `signs`: which way round
- `motion`: the kind of a run and its settings; `names`: what the names of files say about its conditions,
  `counters`: what in them merely counts
- `rows`: the rows that can be used; `likeness`: runs that repeat others; `correlation`: how alike two signals are
- `files`: which files; `reading`: the measurements in them; `finding`: all of the above about one of them
- `imported`: the runs of all files together; `text`: the dataset file with its remarks
"""
