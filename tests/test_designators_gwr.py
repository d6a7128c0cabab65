"""The growing network: habituation in closed form, growth, and what is novel on a drive."""

import math

import numpy as np
import pytest
from designator_drives import ROOM, spots, straight
from scipy import integrate

from ssrics_like.designators import designate, make_designator
from ssrics_like.designators.gwr import (
    ALPHA,
    OLDEST_EDGE,
    TAU_NEIGHBOUR,
    TAU_WINNER,
    GrowingNetwork,
    habituated,
)


@pytest.mark.parametrize("tau", [TAU_WINNER, TAU_NEIGHBOUR])
def test_habituation_solves_its_differential_equation(tau):
    """Tau dh/dt = alpha (1 - h) - 1, from fresh."""
    solved = integrate.solve_ivp(
        lambda _, h: (ALPHA * (1.0 - h) - 1.0) / tau, (0.0, 8.0), [1.0],
        t_eval=range(9), rtol=1e-10, atol=1e-12,
    )  # fmt: skip
    curve = [habituated(1.0, tau, n) for n in range(9)]
    assert curve == pytest.approx(solved.y[0], abs=1e-8)
    closed = [1.0 - (1.0 - math.exp(-ALPHA * n / tau)) / ALPHA for n in range(9)]
    assert curve == pytest.approx(closed)


def test_habituation_stimulus_by_stimulus_is_that_of_all_at_once():
    firing = 1.0
    for _ in range(7):
        firing = habituated(firing, TAU_WINNER)
    assert firing == pytest.approx(habituated(1.0, TAU_WINNER, 7))
    assert habituated(1.0, TAU_WINNER, 1000) == pytest.approx(1.0 - 1.0 / ALPHA)


HERE, THERE, ELSEWHERE = np.array([0.0, 0.0]), np.array([9.0, 0.0]), np.array([0.0, 9.0])


def network(nodes_max=100):
    return GrowingNetwork(activity=0.7, tired=0.3, nodes_max=nodes_max)


def test_what_is_met_again_and_again_is_less_and_less_novel():
    net = network()
    net.meet(HERE)
    net.meet(THERE)
    novelty = [net.meet(HERE) for _ in range(6)]
    assert novelty == pytest.approx([habituated(1.0, TAU_WINNER, n) for n in range(6)])
    assert len(net.firing) == 2


def test_the_network_grows_when_a_trained_node_does_not_know_the_input():
    net = network()
    net.meet(HERE)
    net.meet(THERE)
    assert [net.meet(ELSEWHERE) for _ in range(2)] != [1.0, 1.0]  # the node is still fresh
    net = network()
    for x in (HERE, THERE, *[HERE] * 8):
        net.meet(x)
    assert net.firing[0] < 0.3
    assert net.meet(ELSEWHERE) == 1.0
    assert len(net.firing) == 3
    assert net.weights[2] == pytest.approx(0.5 * (HERE + ELSEWHERE))
    # Half-way is not there yet: it grows towards the input, until the input is known.
    for _ in range(60):
        last = net.meet(ELSEWHERE)
    assert np.linalg.norm(net.weights - ELSEWHERE, axis=1).min() < -math.log(0.7)
    assert last < 0.1


def test_a_node_moves_towards_its_input_less_and_less():
    net = network()
    net.meet(HERE)
    net.meet(THERE)
    near = np.array([0.1, 0.0])
    places = [0.0]
    for n in range(3):
        net.meet(near)
        # A tenth of the way, times the firing before.
        places.append(places[-1] + 0.1 * habituated(1.0, TAU_WINNER, n) * (0.1 - places[-1]))
        assert net.weights[0, 0] == pytest.approx(places[-1])


def test_the_network_grows_no_larger_than_it_may():
    rng = np.random.default_rng(0)
    net = network(nodes_max=7)
    free = network(nodes_max=10_000)
    for x in rng.uniform(-20.0, 20.0, (600, 3)):
        net.meet(x)
        free.meet(x)
    assert len(net.firing) == len(net.weights) <= 7
    assert len(free.firing) > 30


def test_a_node_whose_links_have_all_grown_old_is_forgotten():
    net = network()
    for x in (HERE, THERE, *[HERE] * 8, ELSEWHERE):
        net.meet(x)
    between = net.weights[2].copy()  # linked to both; its second best is the node at HERE
    for _ in range(OLDEST_EDGE - 1):
        net.meet(between)
    assert len(net.firing) == 3
    for _ in range(2):
        net.meet(between)
    assert len(net.firing) == len(net.weights) == 2
    assert np.linalg.norm(net.weights - THERE, axis=1).min() > 5.0


def test_what_is_new_on_a_drive_is_marked_and_what_is_known_is_not():
    niche = np.where(np.arange(ROOM.size) < 45, 0.8, 3.0)

    def ranges(x):
        return niche if 20.0 <= x < 21.0 or 40.0 <= x < 41.0 else ROOM

    drive = straight(60.0, ranges=ranges)
    marks = designate(make_designator("gwr"), drive)
    assert spots(drive, marks)[:, 0] == pytest.approx([0.0, 20.0], abs=0.1)
