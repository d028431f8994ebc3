"""Rays walked with a record of the sums that make up the probability of their ways.

A ray's way through a stack is drawn from a density whose logarithm is linear in a few sums over
the way: lengths, and how often what was met. With these kept (`hylios.transport.equivalent.SUMS`),
the way can serve for other stacks of the same geometry (`hylios.transport.paths`). Melanosomes that
have to be drawn again count among those tried, so that the density is right for these too.
"""

from hylios.transport.compiling import kernel
from hylios.transport.equivalent import walk_with_sums
from hylios.transport.events import LOST, SUBSURFACE


@kernel
def record_paths(sources):
    """The compiled kernel; its arguments are those of `record`."""

    def record(layers, surroundings, readings, sine, cosine, state, rays, places, sums):
        """Walk rays and keep those that leave through the surface after having been inside.

        Parameters
        ----------
        layers, surroundings, readings, sine, cosine, state
            As in `hylios.transport.kernels`.
        rays : int
        places : (rays, 2) float array, written
            x and y in cm where each ray kept left.
        sums : (rays, L, len(SUMS)) float array of zeros, written
            `SUMS` of each ray kept. The row after the last is not zeros.

        Returns
        -------
        int
            How many rays were kept; -1 if one was lost.
        """
        _ = sources  # makes the kernel a closure over it, see `compiling`
        kept = 0
        for _ray in range(rays):
            for layer in range(sums.shape[1]):
                for column in range(sums.shape[2]):
                    sums[kept, layer, column] = 0.0
            end, _, position, _ = walk_with_sums(
                layers, surroundings, readings, (sine, 0.0, cosine), state, sums, kept
            )
            if end == LOST:
                return -1
            if end == SUBSURFACE:
                places[kept, 0], places[kept, 1] = position[0], position[1]
                kept += 1
        return kept

    return record
