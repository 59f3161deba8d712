"""Waits for the engine: a bar of tqdm where somebody looks, and Ctrl-C."""

import atexit
import contextlib
import sys
import weakref

LOOK_EVERY_S = 0.1
AT_EXIT_S = 10.0  # for what goes on in the background to end by itself

_begun = weakref.WeakSet()


def wait_for(work, progress, look):
    """Until the work has ended; look() is called now and then. progress: True, False, or None for where somebody looks.

    KeyboardInterrupt asks the work to stop, waits until it has, and is raised then; a second one is raised at once."""
    _begun.add(work)
    with _bar(progress) as show:
        try:
            while not work.wait(LOOK_EVERY_S):
                show(work.progress())
                look()
            show(work.progress())
            look()
        except BaseException as exception:  # what look() raises ends the work as well
            work.stop()
            while isinstance(exception, KeyboardInterrupt) and not work.wait(LOOK_EVERY_S):
                pass
            raise


def _is_watched():
    return sys.stderr.isatty() or "ipykernel" in sys.modules


@contextlib.contextmanager
def _bar(progress):
    """A function that shows work.progress()."""
    make = _tqdm() if (_is_watched() if progress is None else progress) else None
    if progress and make is None:
        raise ImportError("progress=True needs tqdm: pip install tqdm")
    if make is None:
        yield lambda update: None
        return
    bars = _Bars(make)
    try:
        yield bars.show
    finally:
        bars.close()


def _tqdm():
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return None
    return tqdm


class _Bars:
    """One bar for each stage of the work."""

    def __init__(self, make):
        self._make, self._bar, self._stage = make, None, ""

    def show(self, update):
        stage, counted, done, total, _, _ = update
        if not stage:
            return
        if stage != self._stage:
            self.close()
            self._stage, self._bar = stage, self._make(desc=stage, unit=f" {counted}", total=total or None)
        self._bar.total = total or None
        self._bar.n = done
        self._bar.refresh()

    def close(self):
        if self._bar is not None:
            self._bar.close()
            self._bar = None


@atexit.register
def _end_all():
    for work in list(_begun):
        work.stop()
        work.wait(AT_EXIT_S)
