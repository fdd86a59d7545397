"""Sequences to measure on: clips and rendered scenarios, as rawlogs kept in a work folder."""

import configparser
import dataclasses
import pathlib
import subprocess

HERE = pathlib.Path(__file__).resolve().parent
LARGEST_RAWLOG_KEPT = 1_000_000_000  # bytes; longer ones are imported again from their images


@dataclasses.dataclass
class Sequence:
    """A folder in TUM layout and its rawlog, which import_() makes where it is missing."""

    name: str
    folder: pathlib.Path
    rawlog: pathlib.Path
    import_options: list
    synthetic: bool = False

    @property
    def truth(self):
        path = self.folder / "groundtruth.txt"
        return path if path.exists() else None

    def import_(self, programs):
        if self.rawlog.exists():
            return
        self.rawlog.parent.mkdir(parents=True, exist_ok=True)
        part = self.rawlog.with_suffix(".part")
        subprocess.run(
            [programs / "rgbd-import", self.folder, part, "--quiet", *self.import_options],
            check=True)
        part.rename(self.rawlog)

    def drop_if_large(self):
        if self.rawlog.stat().st_size > LARGEST_RAWLOG_KEPT:
            self.rawlog.unlink()


def read_ini(name):
    ini = configparser.ConfigParser()
    ini.optionxform = str
    ini.read(HERE / name, encoding="utf-8")
    return ini


def _camera_options(clip, name, work):
    """Options for rgbd-import; writes the camera's file where a pinhole is given."""
    if "camera" in clip:
        return ["--camera", clip["camera"]]
    fx, fy, cx, cy = clip["pinhole"].split()
    path = work / f"{name}.ini"
    path.write_text(
        f"[CAMERA_PARAMS]\nresolution = [640 480]\nfx = {fx}\nfy = {fy}\ncx = {cx}\ncy = {cy}\n"
        f"depth_units = {clip['depth_units']}\n", encoding="utf-8")
    return ["--camera", path]


def clips(data, work, wanted):
    """The clips of clips.ini that are in the data folder."""
    ini = read_ini("clips.ini")
    return [
        Sequence(name, data / name, work / f"{name}.rawlog",
                 _camera_options(ini[name], name, work))
        for name in ini.sections() if wanted(name) and (data / name / "rgb.txt").exists()
    ]


def _render(name, frames, folder, programs):
    limit = ["--frames", str(frames)] if frames else []
    subprocess.run([programs / "rgbd-synth", name, folder, *limit], check=True)


def scenarios(work, rendered, wanted, programs):
    """The scenarios of scenarios.ini, rendered unless the folder `rendered` or an earlier
    benchmark has them."""
    ini = read_ini("scenarios.ini")
    found = []
    for name in filter(wanted, ini.sections()):
        folder = rendered / name
        if not folder.exists():
            rendered.mkdir(parents=True, exist_ok=True)
            _render(name, ini.getint(name, "frames", fallback=0), folder, programs)
        rawlog = work / f"synth-{name}.rawlog"
        found.append(Sequence(name, folder, rawlog, ["--camera", folder / "camera.ini"], True))
    return found
