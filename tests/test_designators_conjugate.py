"""Closed forms of conjugate beliefs against integrals, published values and one another."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import integrate, stats

from ssrics_like.designators.conjugate import NormalInverseGamma, dirichlet_kl


def belief(mean, weight, shape, scale):
    return NormalInverseGamma(*(np.array([float(v)]) for v in (mean, weight, shape, scale)))


def test_dirichlet_kl_of_two_bins_is_that_of_betas():
    """KL(Beta(2, 1) || Beta(1, 1)): the integral over p of 2p ln 2p, ln 2 - 1/2."""
    kl = dirichlet_kl(np.array([2.0, 1.0]), np.array([1.0, 1.0]))
    assert kl == pytest.approx(math.log(2.0) - 0.5, abs=1e-12)


def test_dirichlet_kl_is_its_integral():
    a, b = (3.2, 0.9), (1.1, 2.4)

    def integrand(p):
        here = stats.beta.logpdf(p, *a)
        return math.exp(here) * (here - stats.beta.logpdf(p, *b))

    expected = integrate.quad(integrand, 0.0, 1.0)[0]
    assert dirichlet_kl(np.array(a), np.array(b)) == pytest.approx(expected, abs=1e-7)


@given(st.lists(st.tuples(st.floats(0.05, 50.0), st.floats(0.05, 50.0)), min_size=1, max_size=8))
def test_dirichlet_kl_is_never_negative_and_zero_for_equals(pairs):
    one, other = np.array(pairs).T
    assert dirichlet_kl(one, other) >= 0.0
    assert dirichlet_kl(one, one) == pytest.approx(0.0, abs=1e-9)


def test_normal_inverse_gamma_kl_is_its_integral():
    post, prior = belief(0.4, 3.0, 2.5, 1.2), belief(-0.2, 1.0, 1.5, 0.8)

    def log_density(b, mean, variance):
        m, k, a, s = (float(element[0]) for element in b)
        return stats.norm.logpdf(mean, m, math.sqrt(variance / k)) + stats.invgamma.logpdf(
            variance, a, scale=s
        )

    def integrand(mean, log_variance):
        variance = math.exp(log_variance)
        here = log_density(post, mean, variance)
        return math.exp(here) * (here - log_density(prior, mean, variance)) * variance

    def spread(log_variance):
        return 9.0 * math.exp(0.5 * log_variance) / math.sqrt(3.0)

    expected = integrate.dblquad(
        integrand, -4.0, 6.0, lambda v: 0.4 - spread(v), lambda v: 0.4 + spread(v), epsabs=1e-6
    )[0]
    assert post.kl(prior)[0] == pytest.approx(expected, abs=1e-4)


def test_kl_of_beliefs_that_differ_in_the_mean_alone():
    """kappa (m - m0)^2 a / (2 b): the expected precision is a / b."""
    kl = belief(2.0, 3.0, 4.0, 5.0).kl(belief(0.5, 3.0, 4.0, 5.0))
    assert kl[0] == pytest.approx(0.5 * 3.0 * 1.5**2 * 4.0 / 5.0)


def test_the_belief_after_data_is_that_of_the_closed_form():
    """Murphy (2007), equations 86 to 89, with n data at once."""
    rng = np.random.default_rng(0)
    x = rng.normal(1.0, 2.0, 30)
    m0, k0, a0, b0 = 0.3, 0.7, 1.4, 2.0
    after = belief(m0, k0, a0, b0)
    for datum in x:
        after = after.after(np.array([datum]))
    n, mean = x.size, x.mean()
    scale = b0 + 0.5 * ((x - mean) ** 2).sum() + 0.5 * k0 * n * (mean - m0) ** 2 / (k0 + n)
    expected = ((k0 * m0 + n * mean) / (k0 + n), k0 + n, a0 + n / 2, scale)
    assert [float(element[0]) for element in after] == pytest.approx(expected)


def test_the_predictive_is_students_t():
    m, k, a, b = 0.3, 1.7, 2.2, 0.9
    x = np.array([-3.0, 0.0, 0.3, 5.0])
    expected = stats.t.logpdf(x, 2 * a, m, math.sqrt(b * (k + 1) / (a * k)))
    assert belief(m, k, a, b).log_predictive(x) == pytest.approx(expected)


def test_fading_ends_at_the_prior_and_keeps_the_mean():
    prior, now = belief(0.0, 1.0, 1.0, 1.0), belief(3.0, 9.0, 5.0, 2.0)
    assert [float(e[0]) for e in now.faded(0.5, prior)] == [3.0, 5.0, 3.0, 1.5]
    assert [float(e[0]) for e in now.faded(0.0, prior)] == [3.0, 1.0, 1.0, 1.0]
    assert now.faded(1.0, prior) == now
