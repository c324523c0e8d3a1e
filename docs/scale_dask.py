"""Makes a pyramid of tiles with many processes, by Dask (pip install 'dask[distributed]').

    python scale_dask.py FILE DIR --levels 0..8 --parts 64

Without --scheduler, a cluster of worker processes is started on this machine. On several machines, DIR is a folder that all of
them share. With --kill, a worker and all that it has started are killed in the middle, to show that nothing is lost.
"""

import argparse
import hashlib
import os
import pathlib
import signal
import subprocess
import time

import psutil
from dask.distributed import Client, LocalCluster, as_completed


def make(words, part, parts):
    """Makes one part. A part that is made twice, also at the same time, has the same files."""
    words = [*words, "--part", f"{part}/{parts}", "--threads", "1"]
    done = subprocess.run(words, capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(done.stderr)
    return done.stdout.strip()


def kill(client):
    """Kills a worker that is at work, with its children, as the loss of a machine would."""
    busy = [address for address, tasks in client.processing().items() if tasks]
    pids = client.run(os.getpid)
    worker = psutil.Process(pids[busy[0]])
    children = worker.children(recursive=True)
    for process in [worker, *children]:
        process.send_signal(signal.SIGKILL)
    print(f"killed worker {worker.pid} and {len(children)} processes of it")


def digest(folder):
    """The number of files, their bytes, and a hash over all paths and contents."""
    files = sorted(path for path in pathlib.Path(folder).rglob("*") if path.is_file())
    whole, size = hashlib.sha256(), 0
    for path in files:
        content = path.read_bytes()
        size += len(content)
        whole.update(f"{path.relative_to(folder)} {hashlib.sha256(content).hexdigest()}\n".encode())
    return f"{len(files)} files, {size} bytes, sha256 {whole.hexdigest()}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file")
    parser.add_argument("dir")
    parser.add_argument("--levels", default="0..6")
    parser.add_argument("--parts", type=int, default=32)
    parser.add_argument("--workers", type=int, default=os.cpu_count())
    parser.add_argument("--scheduler", help="address of a running scheduler, such as tcp://10.0.0.1:8786")
    parser.add_argument("--lsys", default="lsys", help="the program")
    parser.add_argument("--kill", action="store_true")
    options = parser.parse_args()

    words = [options.lsys, "tiles", options.file, options.dir, "--levels", options.levels]
    cluster = options.scheduler or LocalCluster(
        n_workers=options.workers, threads_per_worker=1, processes=True, dashboard_address=None
    )
    start = time.time()
    with Client(cluster) as client:
        parts = [client.submit(make, words, part, options.parts, pure=False) for part in range(options.parts)]
        for done, part in enumerate(as_completed(parts), 1):
            print(f"{done}/{options.parts}: {part.result()}", flush=True)
            if options.kill and done == options.parts // 4:
                kill(client)
    if not options.scheduler:
        cluster.close()
    print(f"{time.time() - start:.1f} s")

    # A last run on one machine finds nothing to do, and removes what the killed processes have left behind.
    print(subprocess.run(words, capture_output=True, text=True, check=True).stdout.strip())
    print(digest(options.dir))


if __name__ == "__main__":
    main()
