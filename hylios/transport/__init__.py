"""Random walk of light through plane layers, compiled with numba.

Importing a module of this package imports numba, and so does the earlier model
`hylios.lab.predecessors.biospec`. Nothing else in `hylios` imports it before rays are walked. The
modules build on each other in this order:

- `generator`, `vectors`, `sampling`, `interfaces`, `melanosome`: what is drawn, and what happens at
  a face or in a melanosome; `compiling` and `kernel_cache` compile it.
- `stack_arrays`, `events`: a stack as the kernels take it, what rays meet in it and how they end.
- `printed`, `equivalent`: the walk as the thesis prints it, and without waste; `kernels`,
  `path_sums`: compiled loops over rays; `melanosome_paths`: survival in a melanosome, walked.
- `simulate`: spectra; `angular`: the BRDF; `radial`: the exitance about a beam; `tallies`: sums
  over rays.
- `paths`, `path_mixture`, `ray_allocation`, `shared_profiles`: profiles of many stacks from paths
  that they share.
- `survival_table`: makes the table in `hylios.tissue.melanosome_survival`.
"""
