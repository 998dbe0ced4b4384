#!/usr/bin/python3
"""Measures what a user waits for: --help of every command, and a run on the shipped table. Prints
median and smallest times, peak memory and the size of the report.

bench/commands.py PROGRAM   (from the source folder)
"""
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import time


def measure(command, times, before=lambda: None):
    """Median and smallest wall time [s] of the command, and its peak resident memory [MiB], without
    those of other processes that it starts."""
    seconds, peak = [], 0
    for _ in range(times):
        before()
        start = time.perf_counter()
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        errors = process.stderr.read()
        _, status, usage = os.wait4(process.pid, 0)
        seconds.append(time.perf_counter() - start)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode != 0:
            sys.exit(f"{command}: {errors.decode()}")
        peak = max(peak, usage.ru_maxrss)
    return statistics.median(seconds), min(seconds), peak / 1024


program = sys.argv[1]
manual = subprocess.run([program, "man"], capture_output=True, text=True, check=True).stdout
names = re.findall(r"^\.SS (\w+)", manual, re.M)
times = ((measure([program, name, "--help"], 11), name) for name in names)
(median, least, memory), name = max(times, key=lambda found: found[0][0])
print(f"--help, slowest of {len(names)} commands ({name}): median {median * 1e3:.1f} ms, "
      f"least {least * 1e3:.1f} ms, {memory:.0f} MB")

with tempfile.TemporaryDirectory() as folder:
    # The run has the shipped table of the lecture's case: tabulate finds it up to date, and the
    # other stages run.
    case, run = "data/cases/lecture.toml", os.path.join(folder, "run")

    def fresh():
        shutil.rmtree(run, ignore_errors=True)
        os.mkdir(run)
        shutil.copy("data/tables/lecture.csv", os.path.join(run, "table.csv"))

    median, least, memory = measure([program, "run", case, "-o", run], 7, fresh)
    print(f"run on the shipped table, report included: median {median:.2f} s, "
          f"least {least:.2f} s, {memory:.0f} MB")
    print(f"report.html: {os.path.getsize(os.path.join(run, 'report.html')) / 1e6:.2f} MB")
