"""Progress, Ctrl-C, threads and processes."""

import _thread
import concurrent.futures
import multiprocessing
import threading
import time

import numpy as np
import prohull
import pytest

TAKES_SECONDS = dict(faces_target=100, tight=True, best_of=50)


def test_progress_is_told_on_the_calling_thread(pony):
    told = []
    prohull.build(pony, faces_target=300, tight=True,
                  progress=lambda stage, fraction: told.append((stage, fraction, threading.get_ident())))
    assert told[-1][:2] == ("done", 1.0)
    assert all(0 <= fraction <= 1 for _, fraction, _ in told)
    assert {thread for _, _, thread in told} == {threading.get_ident()}


def test_progress_can_stop_a_build(pony):
    start = time.monotonic()
    with pytest.raises(KeyboardInterrupt, match="progress returned False"):
        prohull.build(pony, progress=lambda stage, fraction: stage == "start", **TAKES_SECONDS)
    assert time.monotonic() - start < 5


def test_what_progress_raises_goes_on_to_the_caller(pony):
    def progress(stage, fraction):
        if stage != "start":
            raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        prohull.build(pony, progress=progress, **TAKES_SECONDS)


@pytest.mark.parametrize("work", ["build", "query"])
def test_ctrl_c_interrupts(pony, work):
    """As Ctrl-C does, by a signal to the main thread while it waits in C++."""
    rays = np.random.default_rng(3).normal(size=(2, 20000, 3))
    interrupt = threading.Timer(0.3, _thread.interrupt_main)
    interrupt.start()
    start = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        if work == "build":
            prohull.build(pony, **TAKES_SECONDS)
        else:
            pony.all_hits(*rays, engine="brute")
    interrupt.join()
    assert 0.25 < time.monotonic() - start < 5


def test_other_threads_run_meanwhile(pony):
    ticks = []
    done = threading.Event()

    def tick():
        while not done.wait(0.005):
            ticks.append(time.monotonic())

    thread = threading.Thread(target=tick)
    thread.start()
    prohull.build(pony, faces_target=300, tight=True)
    done.set()
    thread.join()
    assert len(ticks) > 5


def test_threads_share_a_hull(hull):
    rays = np.random.default_rng(4).normal(size=(2, 500, 3))
    expected = hull.first_hit(*rays)
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        for hits in pool.map(lambda _: hull.first_hit(*rays), range(8)):
            assert np.array_equal(hits.face, expected.face)


def ask(hull, rays):
    return hull.first_hit(*rays).face, prohull.build(hull, faces_target=100).certified


@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_processes_share_a_hull(hull, method):
    rays = np.random.default_rng(5).normal(size=(2, 100, 3))
    expected = hull.first_hit(*rays).face  # with threads, before the processes start
    with concurrent.futures.ProcessPoolExecutor(2, multiprocessing.get_context(method)) as pool:
        for face, certified in pool.map(ask, [hull] * 2, [rays] * 2):
            assert np.array_equal(face, expected) and certified
