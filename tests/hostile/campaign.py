"""Breaks every input file of every command and judges what the program makes of it."""
import collections
import concurrent.futures
import fnmatch
import hashlib
import json
import os
import pathlib
import random
import re
import shutil
import signal
import socket
import subprocess
import threading
import time
import zlib

import mutations
from mutations import BROKEN, HARMLESS, VALUE

MAX_SECONDS = 20
MAX_BYTES = 1 << 30
# What a library or the language says, not the program.
RAW_TEXT = re.compile(
    r"std::|basic_|OpenCV\(|cv::|what\(\)|terminate called|filesystem error|bad_alloc|[Aa]ssert|"
    r"json\.exception|yaml-cpp|\.(cpp|h|hpp):\d|vector::|stoi|stod|Sanitizer|__")
CRASH, HANG, MEMORY, RAW, SILENT, UNCLEAR, REFUSED_GOOD = (
    "crash", "hang", "memory", "raw text", "silent", "unclear", "harmless, refused")
REFUSED, WARNED, NO_EFFECT, ACCEPTED = "refused", "warned", "no effect", "another value"
FAULTS = (CRASH, HANG, MEMORY, RAW, SILENT, UNCLEAR, REFUSED_GOOD)

# Files of a folder by their format; * stands for the frame that is broken.
SEQUENCE = {"rgb.txt": "list", "depth.txt": "list", "associations.txt": "list", "groundtruth.txt": "list",
            "camera.yaml": "yaml", "detections.jsonl": "jsonl", "manifest.json": "json",
            "gt/scene.json": "json", "gt/frames.jsonl": "jsonl", "rgb/*.png": "colour", "depth/*.png": "depth",
            "gt/plane_id/*.png": "ids", "gt/object_id/*.png": "ids"}
RUN = {"run.json": "json", "trajectory.txt": "list", "keyframes.txt": "list", "frame_planes.jsonl": "jsonl",
       "map.json": "json", "timing.csv": "csv", "segmentation/*.png": "ids", "map.ply": "text",
       "trajectory_covariance.txt": "list"}
SCENES = {"scene.yaml": "yaml", "sensor.yaml": "yaml", "path.txt": "list", "config.yaml": "yaml",
          "slam_camera.yaml": "yaml", "poses.csv": "csv", "warp.yaml": "yaml"}

Command = collections.namedtuple("Command", "name arguments reads")
# What is run, below a folder of inputs, and the files that it reads. `out` is what it writes.
COMMANDS = (
    Command("scene show", "scene show scene.yaml", ["scene.yaml"]),
    Command("sim", "sim scene.yaml -o out --frames 2 --width 160 --height 120 --sensor sensor.yaml "
            "--trajectory path.txt", ["scene.yaml", "sensor.yaml", "path.txt"]),
    Command("slam --live", "slam --live scene.yaml -o out --frames 2 --width 160 --height 120 --config config.yaml",
            ["scene.yaml", "config.yaml"]),
    Command("slam", "slam seq -o out --camera slam_camera.yaml", ["slam_camera.yaml"]),
    Command("slam --depth-warp", "slam seq -o out --depth-warp warp.yaml", ["warp.yaml"]),
    Command("slam", "slam seq -o out", ["seq/" + f for f in SEQUENCE if not f.startswith("gt/")]),
    Command("eval", "eval run --truth seq -o out", ["seq/" + f for f in SEQUENCE] + ["run/" + f for f in RUN]),
    Command("eval --trajectory", "eval --trajectory run/trajectory.txt --truth seq/groundtruth.txt -o out",
            ["run/trajectory.txt", "seq/groundtruth.txt"]),
    Command("eval --trajectory", "eval --trajectory poses.csv --truth seq/groundtruth.txt -o out", ["poses.csv"]),
    Command("eval --segmentation", "eval --segmentation run/segmentation --truth seq -o out",
            ["run/segmentation/*.png", "seq/gt/plane_id/*.png"]),
    Command("plot", "plot run --truth seq -o out", ["run/trajectory.txt", "run/timing.csv"]),
    Command("draw", "draw run --truth seq -o out --frames 3", ["seq/" + f for f in SEQUENCE] +
            ["run/" + f for f in RUN]),
    Command("export", "export seq -o out --format coco", ["seq/" + f for f in SEQUENCE]),
    Command("check", "check seq", ["seq/" + f for f in SEQUENCE]),
    Command("check", "check run", ["run/" + f for f in RUN]),
)
FORMATS = {**SCENES, **{"seq/" + f: kind for f, kind in SEQUENCE.items()}, **{"run/" + f: k for f, k in RUN.items()}}

Case = collections.namedtuple("Case", "file name expected content command")
Result = collections.namedtuple("Result", "case outcome code said seconds")


def make_corpus(pas, folder):
    """One small recording with everything in it: 8 frames of a desk, its run, and settings."""
    folder.mkdir(parents=True)

    def run(*arguments):
        subprocess.run([pas, "-q", *arguments], cwd=folder, check=True)

    run("scene", "make", "--family", "desk", "--seed", "3", "-o", "scene.yaml")
    run("sim", "--sensor", "kinect1-clean", "scene.yaml", "-o", "seq", "--frames", "8", "--width", "320", "--height", "240")
    run("slam", "seq", "-o", "run", "--save-segmentation", "--threads", "1")
    (folder / "sensor.yaml").write_text("base: kinect1\nmin_depth_m: 0.5\nmax_depth_m: 4\n")
    lines = (folder / "seq/groundtruth.txt").read_text().splitlines()
    (folder / "path.txt").write_text("\n".join(lines[:4]) + "\n")
    (folder / "config.yaml").write_text("sensor:\n  model: kinect1\n  max_depth_m: 3.5\n")
    (folder / "poses.csv").write_text("".join(map(euroc_line, (folder / "run/trajectory.txt").read_text().splitlines())))
    (folder / "warp.yaml").write_text(warp_text(16, 12))
    (folder / "slam_camera.yaml").write_text((folder / "seq/camera.yaml").read_text())


def warp_text(cols, rows):
    """A pattern of a depth camera of 320 x 240: a wave across the image."""
    def table(value):
        return "".join(f"  - [{', '.join(str(value(x)) for x in range(cols))}]\n" for _ in range(rows))
    return (f"format: pas-depth-warp/1\nimage: {{width: 320, height: 240}}\ncells: {{cols: {cols}, rows: {rows}}}\n"
            f"pattern_ppm:\n{table(lambda x: 300 * (x % 4))}sigma_ppm:\n{table(lambda x: 100)}")


def euroc_line(line):
    """A pose of TUM as EuRoC writes it."""
    if line.startswith("#"):
        return "#timestamp [ns],x,y,z,qw,qx,qy,qz\n"
    t, x, y, z, qx, qy, qz, qw = line.split()
    return f"{round(float(t) * 1e9)},{x},{y},{z},{qw},{qx},{qy},{qz}\n"


def frame_file(folder, pattern):
    """The file of the frame in the middle that a pattern stands for."""
    files = sorted(folder.glob(pattern)) if "*" in pattern else [folder / pattern]
    return files[len(files) // 2].relative_to(folder)


PLACES = ("not there", "a folder", "a FIFO", "a link to /dev/zero", "a link to nothing", "a link to itself",
          "a socket", "no permission")


def put_place(path, place):
    """Something else than a file where the file should be."""
    path.unlink()
    if place == "a folder":
        path.mkdir()
    elif place == "a FIFO":
        os.mkfifo(path)
    elif place == "a link to /dev/zero":
        path.symlink_to("/dev/zero")
    elif place == "a link to nothing":
        path.symlink_to("nothing")
    elif place == "a link to itself":
        path.symlink_to(path.name)
    elif place == "a socket":
        here = os.open(path.parent, os.O_RDONLY)  # the name of a socket may have 107 bytes only
        try:
            socket.socket(socket.AF_UNIX).bind(f"/proc/self/fd/{here}/{path.name}")
        finally:
            os.close(here)
    elif place == "no permission":
        path.write_bytes(b"")
        path.chmod(0)


def mend_hash(folder, case):
    """The manifest agrees with the broken file: `check` has to see by itself what is wrong."""
    manifest = folder / "seq/manifest.json"
    if case.file.startswith("seq/") and case.file != "seq/manifest.json":
        tree = json.loads(manifest.read_text())
        tree["sha256"][case.file.removeprefix("seq/")] = hashlib.sha256(case.content).hexdigest()
        manifest.unlink()
        manifest.write_text(json.dumps(tree, indent=1) + "\n")


def all_cases(corpus, seed):
    """Every mutation of every file, for every command that reads it."""
    for pattern, kind in FORMATS.items():
        file = frame_file(corpus, pattern)
        data = (corpus / file).read_bytes()
        rng = random.Random(f"{seed} {pattern}")
        broken = [(name, expected, content) for name, expected, content in mutations.of_format(kind, data, rng)]
        broken += [(place, BROKEN, None) for place in PLACES if place != "no permission" or os.getuid() != 0]
        for name, expected, content in broken:
            for command in COMMANDS:
                if pattern in command.reads:
                    yield Case(str(file), name, expected, content, command)


def option_cases(pas):
    """Every numeric option of every command with values that no number may have."""
    listed = re.compile(r"^  (?:-\w,)?(--[\w-]+) (INT|UINT|FLOAT)", re.MULTILINE)
    numeric = [next(c for c in COMMANDS if c.name == name) for name in ("sim", "slam --live", "slam", "eval", "draw")]
    for command in (*numeric, Command("scene make", "scene make -o out", [])):
        helped = subprocess.run([pas, *command.arguments.split()[:2 if command.name == "scene make" else 1], "--help"],
                                capture_output=True, text=True, check=True).stdout
        for option, kind in sorted(set(listed.findall(helped))):
            values = ["nan", "abc", "", "1e999", "0x"] + (["inf", "-inf"] if kind == "FLOAT" else ["-1e30", "1.5", "1e30"])
            values += ["-1"] if kind == "UINT" else []
            for value in values:
                arguments = f"{command.arguments} {option}={value}"
                yield Case("", f"{option}={value}", BROKEN, None, Command(command.name, arguments, []))


class Campaign:
    def __init__(self, pas, work, accepted):
        self.pas, self.work, self.accepted = pas, work, accepted
        self.corpus = work / "corpus"
        self.plain = {}
        self.lock = threading.Lock()

    def run(self, arguments, folder):
        """(exit code, what it said, seconds, most memory in bytes); -1 is a hang"""
        with open(folder / "said", "wb") as said:
            started = time.monotonic()
            process = subprocess.Popen([self.pas, *arguments], cwd=folder, stdin=subprocess.DEVNULL,
                                       stdout=said, stderr=subprocess.STDOUT)
            hung = False
            while True:
                pid, status, usage = os.wait4(process.pid, os.WNOHANG)
                if pid:
                    break
                if time.monotonic() - started > MAX_SECONDS and not hung:
                    hung = True
                    process.send_signal(signal.SIGKILL)
                time.sleep(0.004)
            process.returncode = os.waitstatus_to_exitcode(status)
        seconds = time.monotonic() - started
        text = (folder / "said").read_bytes()[:100000].decode(errors="replace")
        return (-1000 if hung else process.returncode), text, seconds, usage.ru_maxrss * 1024

    def folder_for(self, case, name):
        """Links to the corpus, with one file broken."""
        folder = self.work / "cases" / name
        shutil.copytree(self.corpus, folder, copy_function=os.link)
        if case and case.file:
            path = folder / case.file
            if case.content is None:
                put_place(path, case.name)
            else:
                path.unlink()
                path.write_bytes(case.content)
                mend_hash(folder, case)
        return folder

    def outcome_of_plain(self, command):
        """What the command makes of the whole corpus: exit code, words and files."""
        with self.lock:
            if command.arguments not in self.plain:
                folder = self.folder_for(None, f"plain{len(self.plain)}")
                code, said, _, _ = self.run(command.arguments.split(), folder)
                assert code == 0, f"{command.arguments}: {said}"
                self.plain[command.arguments] = (steady(said), written(folder / "out"))
                shutil.rmtree(folder)
            return self.plain[command.arguments]

    def judge(self, case, number):
        folder = self.folder_for(case, f"{number}")
        try:
            code, said, seconds, most = self.run(case.command.arguments.split(" "), folder)
            return Result(case, self.verdict(case, folder, code, said, most), code, said, seconds)
        finally:
            shutil.rmtree(folder)

    def verdict(self, case, folder, code, said, most):
        if code == -1000:
            return HANG
        if code < 0 or code > 2:
            return CRASH
        if most > MAX_BYTES:
            return MEMORY
        complaints = "\n".join(line for line in said.splitlines() if not line.startswith(("slam ", "frames ")))
        if RAW_TEXT.search(complaints):
            return RAW
        same = False
        if case.file:
            words, files = self.outcome_of_plain(case.command)
            same = words == steady(said) and files == written(folder / "out")
        if case.expected == HARMLESS:
            return NO_EFFECT if same or self.is_accepted(case) else REFUSED_GOOD
        if code == 2:
            return REFUSED if names_cause(case, said) else UNCLEAR
        if same and case.command.name != "check":
            return NO_EFFECT
        if case.expected == VALUE:
            return ACCEPTED
        if code == 1 or names_cause(case, complaints) and "warning" in complaints:
            return WARNED
        return NO_EFFECT if self.is_accepted(case) else SILENT

    def is_accepted(self, case):
        return any(fnmatch.fnmatchcase(case.command.name, command) and fnmatch.fnmatchcase(case.file, file)
                   and fnmatch.fnmatchcase(case.name, name) for command, file, name in self.accepted)

    def all(self, cases, threads, report):
        with concurrent.futures.ThreadPoolExecutor(threads) as pool:
            for done, result in enumerate(pool.map(self.judge, cases, range(len(cases))), 1):
                report(done, len(cases))
                yield result


def names_cause(case, said):
    """The message names the file, or one below its folder that disagrees with it, or the option."""
    if not case.file:
        return case.name.split("=")[0] in said
    path = pathlib.PurePath(case.file)
    return path.name in said or len(path.parts) > 1 and re.search(rf"\b{path.parts[0]}\b", said)


def steady(said):
    """Words without what differs between runs: times."""
    return re.sub(r"\d+(\.\d+)? (frames/s|ms|MiB)|(mean|median|below) +[\d.]+|slam \d+/\d+.*|frames \d+/\d+.*", "", said)


TIMES = re.compile(r"wall|peak|time|sha256|version|created|module|path|sequence")


def without_times(tree):
    if isinstance(tree, dict):
        return {key: without_times(value) for key, value in tree.items() if not TIMES.search(key)}
    return [without_times(item) for item in tree] if isinstance(tree, list) else tree


def written(out):
    """Files below a place by what is in them, but for times."""
    files = {}
    for path in sorted(out.rglob("*")) if out.is_dir() else [out] if out.is_file() else []:
        if not path.is_file() or path.name == "timing.csv":
            continue
        data = path.read_bytes()
        if path.name in ("run.json", "metrics.json", "manifest.json", "out"):
            data = json.dumps(without_times(json.loads(data))).encode()
        files[str(path.relative_to(out))] = zlib.crc32(data)
    return files


def read_accepted(path):
    """Lines `command | file | mutation | reason`; * stands for anything."""
    accepted = []
    for line in path.read_text().splitlines():
        if line.strip() and not line.startswith("#"):
            command, file, name, reason = (part.strip() for part in line.split("|"))
            assert reason, f"{path}: no reason in: {line}"
            accepted.append((command, file, name))
    return accepted
