"""Text tables that people give: measured spectra, lamps, sunscreens, schedules, fronts.

One set of rules for all of them, numpy and the standard library only: `text` opens and decodes,
`layout` finds separator, header and rows, `quantities` knows columns by their names and units,
`table` joins them to columns of numbers, `instruments` knows tables whose layout is their maker's,
`cgats` and `cxf` know files of samples, and `spectrum` is what most callers want.

A file is read where its text can mean one thing only, and refused in a sentence with the line
where it can mean two: no reader guesses. Weighed in place of this: `csv.Sniffer` and clevercsv
choose the likeliest layout, so they read what should be refused (clevercsv is compiled besides);
pandas reads a row that is too short, takes a column twice under another name, and is no
dependency for a wheel that Blender carries; colour-science's readers of CxF-like and CSV files
need colour-science and must be told the separator. The standard library's `csv` does the quoting.
"""
