"""The work of the models of hand and face in numpy, to compare times with: the same sizes, random numbers.

Run with one thread: OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 python3 peer.py HAND_FRAMES FACE_FRAMES
"""

import sys
import time

import numpy as np

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


def regress(terms, seen, markers):
    """Regress 150 coordinates on the terms, each marker on the frames that show it."""
    for marker in range(50):
        own = terms[seen[:, marker]]
        gram = own.T @ own + 1e-4 * np.eye(own.shape[1]) * len(own)
        np.linalg.solve(gram, own.T @ markers[seen[:, marker], marker])


def terms_of(angles):
    """Return the cosines and sines of 34 sums of angles, and eight products."""
    sums = np.hstack([angles[:, 3:], angles[:, :12]])
    products = np.sin(angles[:, :8]) * np.cos(sums[:, :8])
    return np.hstack([np.ones((len(angles), 1)), np.cos(sums), np.sin(sums), products])


def hand(frames):
    """Fit forearm and back of the hand, angles by rounds of filling, components, and two regressions."""
    markers = rng.normal(size=(frames, 50, 3))
    angles = rng.normal(size=(frames, 25))
    hidden = rng.random(angles.shape) < 0.15
    seen = rng.random((frames, 50)) > 0.15
    forearm, back = rng.normal(size=(5, 3)), rng.normal(size=(7, 3))
    start = time.perf_counter()
    for _ in range(3):
        rigid(forearm, markers[:, :5])
        rigid(back, markers[:, 5:12])
    filled = np.where(hidden, 0.0, angles)
    for _ in range(7):
        centre, vectors = pca(filled, 12)
        said = (filled - centre) @ vectors @ vectors.T + centre
        filled = np.where(hidden, said, angles)
    few = slice(None, None, max(frames // 1500, 1))
    regress(terms_of(filled[few]), seen[few], markers[few])
    centre, vectors = pca(filled, 20)
    said = (filled - centre) @ vectors @ vectors.T + centre
    terms = terms_of(said)
    regress(terms, seen, markers)
    np.square(markers.reshape(frames, 150) - terms @ rng.normal(size=(terms.shape[1], 150))).mean(0)
    return time.perf_counter() - start


def face(frames):
    """Fit the head four times, then five rounds of seven guided components and the weights of 18 markers."""
    markers = rng.normal(size=(frames, 63, 3))
    mean = rng.normal(size=(9, 3))
    start = time.perf_counter()
    for _ in range(4):
        rigid(mean, markers[:, :9])
    for _ in range(5):
        left = markers.reshape(frames, 189) - markers.reshape(frames, 189).mean(0)
        for size in (16, 32, 7, 7, 2, 54, 36):
            values, vectors = np.linalg.eigh(np.cov(left[:, :size].T))
            p = left[:, :size] @ vectors[:, -1]
            p /= p.std()
            left = left - np.outer(p, left.T @ p / (p @ p))
        np.linalg.lstsq(rng.normal(size=(189, 7)), left.T, rcond=None)
    return time.perf_counter() - start


print(f"{hand(int(sys.argv[1])):.4f}")
print(f"{face(int(sys.argv[2])):.4f}")
