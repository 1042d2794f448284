"""The work of the models of hand and face in numpy, to compare times with: the same sizes, random numbers.

Run with one thread: OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 python3 peer.py
"""

import time

import numpy as np

FRAMES = 10_000
rng = np.random.default_rng(1)


def rigid(mean, seen):
    """Fit the turn and shift of every frame at once (Kabsch)."""
    a, b = mean - mean.mean(0), seen - seen.mean(1, keepdims=True)
    u, _, vt = np.linalg.svd(np.einsum("ni,fnj->fij", a, b))
    d = np.sign(np.linalg.det(np.einsum("fij,fjk->fik", u, vt)))
    vt[:, 2] *= d[:, None]
    turn = np.einsum("fij,fjk->fki", u, vt)
    return turn, seen.mean(1) - np.einsum("fij,j->fi", turn, mean.mean(0))


def pca(rows, keep):
    """Find components by the covariance."""
    mean = rows.mean(0)
    values, vectors = np.linalg.eigh(np.cov(rows.T))
    order = np.argsort(values)[::-1][:keep]
    return mean, vectors[:, order]


def hand():
    """Fit the forearm twice, angles by six rounds of filling, and 150 coordinates by ridge regression on 77 terms."""
    markers = rng.normal(size=(FRAMES, 50, 3))
    mean = rng.normal(size=(5, 3))
    angles = rng.normal(size=(FRAMES, 25))
    hidden = rng.random(angles.shape) < 0.15
    start = time.perf_counter()
    for _ in range(3):
        rigid(mean, markers[:, :5])
    filled = np.where(hidden, 0.0, angles)
    for _ in range(7):
        centre, vectors = pca(filled, 20)
        said = (filled - centre) @ vectors @ vectors.T + centre
        filled = np.where(hidden, said, angles)
    terms = np.hstack([np.ones((FRAMES, 1)), np.cos(filled), np.sin(filled), filled, filled[:, :1]])
    seen = rng.random((FRAMES, 50)) > 0.15
    for marker in range(50):
        own = terms[seen[:, marker]]
        gram = own.T @ own + 1e-4 * np.eye(own.shape[1]) * len(own)
        np.linalg.solve(gram, own.T @ markers[seen[:, marker], marker])
    return time.perf_counter() - start


def face():
    """Fit the head four times, then five rounds of seven guided components and the weights of 18 markers."""
    markers = rng.normal(size=(FRAMES, 63, 3))
    mean = rng.normal(size=(9, 3))
    start = time.perf_counter()
    for _ in range(4):
        rigid(mean, markers[:, :9])
    for _ in range(5):
        left = markers.reshape(FRAMES, 189) - markers.reshape(FRAMES, 189).mean(0)
        for size in (16, 32, 7, 7, 2, 54, 36):
            values, vectors = np.linalg.eigh(np.cov(left[:, :size].T))
            p = left[:, :size] @ vectors[:, -1]
            p /= p.std()
            left = left - np.outer(p, left.T @ p / (p @ p))
        np.linalg.lstsq(rng.normal(size=(189, 7)), left.T, rcond=None)
    return time.perf_counter() - start


print(f"hand, {FRAMES} frames: {hand():.2f} s")
print(f"face, {FRAMES} frames: {face():.2f} s")
