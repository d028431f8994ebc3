"""The compiled entries: rays traced one by one, or only counted, in either way of walking."""

from collections.abc import Callable

import numpy as np

from hylios.transport.compiling import kernel
from hylios.transport.equivalent import walk_equivalent
from hylios.transport.events import ABSORBED, ABSORBED_IN_MELANOSOME, LOST, SUBSURFACE
from hylios.transport.printed import walk_as_printed


def _tracing(as_printed: bool) -> Callable:
    @kernel
    def made(sources):
        def trace(
            layers,
            surroundings,
            readings,
            sine,
            cosine,
            state,
            outcome,
            end_layer,
            place,
            direction,
        ):
            """Trace one ray for each element of `outcome`, or fewer if one is lost.

            Parameters
            ----------
            layers, surroundings, readings
                From `hylios.transport.stack_arrays.kernel_arguments`.
            sine, cosine : float
                Of the angle of incidence; light arrives at the origin along (sine, 0, cosine).
            state : (4,) uint64 array
                Of the generator; advanced.
            outcome : (N,) int8 array, written
                How the ray ended.
            end_layer : (N,) int8 array, written
                Layer in which it was absorbed; -1 if it was not.
            place : (N, 2) float array, written
                x and y in cm where it ended.
            direction : (N, 3) float array, written
                Its direction at the end.

            Returns
            -------
            bool
                Whether all rays found an end.
            """
            _ = sources  # makes the kernel a closure over it, see `compiling`
            for index in range(outcome.size):
                ray = (sine, 0.0, cosine)
                if as_printed:
                    end, layer, position, ray = walk_as_printed(
                        layers, surroundings, readings, ray, state
                    )
                else:
                    end, layer, position, ray = walk_equivalent(
                        layers, surroundings, readings, ray, state, None, 0
                    )
                if end == LOST:
                    return False
                outcome[index], end_layer[index] = end, layer
                place[index, 0], place[index, 1] = position[0], position[1]
                direction[index, 0], direction[index, 1], direction[index, 2] = ray
            return True

        return trace

    return made


def _counting(as_printed: bool) -> Callable:
    @kernel
    def made(sources):
        def count(
            layers, surroundings, readings, sine, cosine, state, rays, edges, left, absorbed, exits
        ):
            """Count how rays end, up to the first that is lost.

            Parameters
            ----------
            layers, surroundings, readings, sine, cosine, state
                As in `trace`.
            rays : int
            edges : (N,) ascending float array
                Where the bins of exit distances begin, in cm, the first at 0.
            left : (3,) int64 array, added to
                Rays by outcome SURFACE, SUBSURFACE, TRANSMITTED.
            absorbed : (2, L) int64 array, added to
                Rays absorbed by each layer's absorbers and in its melanosomes.
            exits : (N,) int64 array, added to
                Subsurface rays by distance from where they came in.

            Returns
            -------
            bool
                Whether all rays found an end.
            """
            _ = sources  # makes the kernel a closure over it, see `compiling`
            for _ray in range(rays):
                ray = (sine, 0.0, cosine)
                if as_printed:
                    end, layer, position, ray = walk_as_printed(
                        layers, surroundings, readings, ray, state
                    )
                else:
                    end, layer, position, ray = walk_equivalent(
                        layers, surroundings, readings, ray, state, None, 0
                    )
                if end == LOST:
                    return False
                if end == ABSORBED:
                    absorbed[0, layer] += 1
                elif end == ABSORBED_IN_MELANOSOME:
                    absorbed[1, layer] += 1
                else:
                    left[end] += 1
                    if end == SUBSURFACE:
                        distance = np.hypot(position[0], position[1])
                        exits[np.searchsorted(edges, distance, side="right") - 1] += 1
            return True

        return count

    return made


trace_equivalent, trace_as_printed = _tracing(False), _tracing(True)
count_equivalent, count_as_printed = _counting(False), _counting(True)
