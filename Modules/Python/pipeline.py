# SPDX-License-Identifier: BSD-3-Clause
"""Running pipelines from Python."""
import re
import signal
import threading
import warnings


class PipelineWarning(UserWarning):
    """A warning of an algorithm of VTK."""


def update(algorithm, progress=None, time=None):
    """Brings an algorithm, and all that it gets its input from, up to date.

    It does what algorithm.Update() does, with `time` what algorithm.UpdateTimeStep(time) does, and:

    - The first error of the pipeline becomes a RuntimeError with its text.
    - Each warning goes to Python's warnings.warn() as a PipelineWarning, so that Python shows it once, and
      `warnings` can make it an error or ignore it.
    - Ctrl-C stops the pipeline within about 0.1 s and raises KeyboardInterrupt. (Update() goes on to its
      end; if a Python function observes its progress, VTK ends the whole process.) The output is empty then,
      and the next update starts anew.
    - `progress(algorithm, fraction)` is called as each of the algorithms goes from 0 to 1. An exception that
      it raises stops the pipeline as Ctrl-C does, and leaves update().
    """
    run = _Run(progress)
    pipeline = _upstream(algorithm)
    for part in pipeline:
        run.observe(part, "ProgressEvent", run.on_progress)
        run.observe(part, "ErrorEvent", run.on_error)
        run.observe(part.GetExecutive(), "ErrorEvent", run.on_failure)
        for subject in (part, part.GetExecutive()):
            run.observe(subject, "WarningEvent", run.on_warning)
    restore = _catch_interrupts(run)
    try:
        if time is None:
            algorithm.Update()
        else:
            algorithm.UpdateTimeStep(time)
    finally:
        restore()
        run.end()
    try:
        # For the line that called update(). The same text, as of each time of a dose, is given once.
        for message in dict.fromkeys(run.warnings):
            warnings.warn(message, PipelineWarning, stacklevel=2)
    finally:
        run.raise_first(pipeline)


class _Run:
    """What happens during an update. Nothing may be raised while VTK runs, so it waits for the end."""

    def __init__(self, progress):
        self.progress = progress
        self.observed = []
        self.stop = None  # the exception that stops the pipeline
        self.errors = []
        self.failures = []
        self.warnings = []

    def observe(self, subject, event, action):
        self.observed.append((subject, subject.AddObserver(event, action)))

    def on_progress(self, part, event):
        if self.progress and not self.stop:
            try:
                self.progress(part, part.GetProgress())
            except BaseException as stop:
                self.stop = stop
        if self.stop:
            part.SetAbortExecute(1)

    def on_interrupt(self, handler, *arguments):
        try:
            handler(*arguments)  # Python's own raises KeyboardInterrupt
        except BaseException as stop:
            self.stop = self.stop or stop

    def on_error(self, part, event, text):
        self.errors.append(_message(text))

    def on_failure(self, executive, event, text):
        self.failures.append(_message(text))

    def on_warning(self, subject, event, text):
        self.warnings.append(_message(text))

    # VTK reads these to know what to hand over.
    on_error.CallDataType = "string0"
    on_failure.CallDataType = "string0"
    on_warning.CallDataType = "string0"

    def end(self):
        # The last first: VTK's wrapping looks for each in a list of all, and then closes the gap.
        for subject, tag in reversed(self.observed):
            subject.RemoveObserver(tag)

    def raise_first(self, pipeline):
        if self.stop:
            for part in pipeline:
                if part.GetAbortExecute():
                    part.SetAbortExecute(0)  # so it is not up to date; VTK 9.3 would abort again
            raise self.stop
        # An executive repeats that its algorithm failed; alone, its report is all there is.
        for message in self.errors + self.failures:
            raise RuntimeError(message)


def _upstream(algorithm):
    """The algorithm and all that it depends on, each once; but for data that is handed over as it is."""
    found, known = [algorithm], {algorithm}
    for part in found:
        for port in range(part.GetNumberOfInputPorts()):
            for i in range(part.GetNumberOfInputConnections(port)):
                producer = part.GetInputConnection(port, i).GetProducer()
                if producer not in known and not producer.IsA("vtkTrivialProducer"):
                    known.add(producer)
                    found.append(producer)
    return found


def _catch_interrupts(run):
    """Hands Ctrl-C to the run; returns the function that puts things back. Only the main thread sees Ctrl-C."""
    handler = signal.getsignal(signal.SIGINT)
    if threading.current_thread() is not threading.main_thread() or not callable(handler):
        return lambda: None
    signal.signal(signal.SIGINT, lambda *arguments: run.on_interrupt(handler, *arguments))
    return lambda: signal.signal(signal.SIGINT, handler)


def _message(text):
    """The text of an error or a warning without the file, the line and the address."""
    return re.sub(r"^(?:ERROR|Warning): In [^\n]*\n(\w+) \(0x\w+\): ", r"\1: ", text).strip()
