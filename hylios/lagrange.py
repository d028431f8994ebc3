"""Lagrange's interpolation by polynomials."""

import numpy as np


def lagrange(nodes: np.ndarray, places: np.ndarray) -> np.ndarray:
    """Values of the polynomials that are 1 at one node and 0 at the others, (places, nodes).

    By the barycentric formula (Berrut and Trefethen 2004), so rows sum to 1.
    """
    apart = nodes[:, None] - nodes[None, :]
    np.fill_diagonal(apart, 1.0)
    terms = places[:, None] - nodes
    hit = terms == 0.0
    terms[hit] = 1.0
    np.divide(1.0 / apart.prod(axis=1), terms, out=terms)
    if hit.any():
        some = hit.any(axis=1)
        terms[some] = hit[some]
    terms /= terms.sum(axis=1, keepdims=True)
    return terms
