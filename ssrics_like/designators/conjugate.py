"""Conjugate beliefs in closed form: Dirichlet, and normal with unknown mean and variance."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.special import digamma, gammaln

Array = NDArray[np.float64]


def dirichlet_kl(posterior: Array, prior: Array) -> float:
    """Return KL(posterior || prior) of two Dirichlet distributions.

    Parameters
    ----------
    posterior, prior : ndarray, shape (bins,)
        Concentrations, above 0.

    Returns
    -------
    float
        Nats, not below 0.

    References
    ----------
    Itti & Baldi (2009), "Bayesian surprise attracts human attention", Vision Research 49,
    which surprise is this; the closed form is Penny (2001), "KL-divergences of normal,
    gamma, Dirichlet and Wishart densities".
    """
    total = posterior.sum()
    kl = (
        gammaln(total)
        - gammaln(prior.sum())
        + (gammaln(prior) - gammaln(posterior)).sum()
        + ((posterior - prior) * (digamma(posterior) - digamma(total))).sum()
    )
    return max(float(kl), 0.0)


class NormalInverseGamma(NamedTuple):
    """A belief about mean and variance of normal data, or one belief an element of the arrays.

    The variance is inverse gamma with `shape` a and `scale` b; the mean, given the
    variance, is normal about `mean` m with the variance divided by `weight` kappa.

    References
    ----------
    Murphy (2007), "Conjugate Bayesian analysis of the Gaussian distribution", section 6.
    """

    mean: Array
    weight: Array
    shape: Array
    scale: Array

    def after(self, x: Array) -> NormalInverseGamma:
        """Return the belief after one datum for each element."""
        weight = self.weight + 1.0
        off = x - self.mean
        return NormalInverseGamma(
            self.mean + off / weight,
            weight,
            self.shape + 0.5,
            self.scale + 0.5 * self.weight / weight * off * off,
        )

    def faded(self, keep: float, prior: NormalInverseGamma) -> NormalInverseGamma:
        """Return the belief with a share of its evidence kept; the mean stays where it is."""
        return NormalInverseGamma(
            self.mean,
            prior.weight + keep * (self.weight - prior.weight),
            prior.shape + keep * (self.shape - prior.shape),
            prior.scale + keep * (self.scale - prior.scale),
        )

    def log_predictive(self, x: Array) -> Array:
        """Return the logarithm of the density of the next datum, Student's t of 2a degrees.

        Its location is m, its squared scale b (kappa + 1) / (a kappa).
        """
        degrees = 2.0 * self.shape
        variance = self.scale * (self.weight + 1.0) / (self.shape * self.weight)
        off = x - self.mean
        density: Array = (
            gammaln(0.5 * (degrees + 1.0))
            - gammaln(0.5 * degrees)
            - 0.5 * np.log(math.pi * degrees * variance)
            - 0.5 * (degrees + 1.0) * np.log1p(off * off / (degrees * variance))
        )
        return density

    def kl(self, prior: NormalInverseGamma) -> Array:
        """Return KL(self || prior) for each element, nats.

        That of the normals, averaged over the variance, and that of the inverse gammas.
        """
        ratio = prior.weight / self.weight
        off = self.mean - prior.mean
        of_mean = 0.5 * (
            ratio - 1.0 - np.log(ratio) + prior.weight * off * off * self.shape / self.scale
        )
        of_variance = (
            (self.shape - prior.shape) * digamma(self.shape)
            - gammaln(self.shape)
            + gammaln(prior.shape)
            + prior.shape * np.log(self.scale / prior.scale)
            + self.shape * (prior.scale - self.scale) / self.scale
        )
        kl: Array = np.maximum(of_mean + of_variance, 0.0)
        return kl
