//! `cargo xtask wheel` and `cargo xtask python`: the Python package, built and tested as
//! users get it.
//!
//! Everything is below `target/`: wheels, and virtual environments that are kept from one
//! run to the next. One environment, of the newest Python, has every package that meshes are
//! handed on to; packages that do not install are named, and their tests skipped. In a second
//! one, of the oldest Python, numpy is alone. The wheel, built with the newest, and what the
//! source distribution becomes with the oldest are installed and tested in both.

use crate::Outcome;
use crate::tidy;
use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

/// The versions of Python that are looked for, as minor numbers.
const MINORS: std::ops::RangeInclusive<u32> = 10..=15;

/// What tests need in any case.
const TOOLS: &[&str] = &["numpy", "pytest", "hypothesis"];

/// What builds and checks the package.
const BUILDERS: &[&str] = &["maturin>=1.8,<2", "ziglang"];

/// Packages that meshes are handed on to, and checkers of types.
const CLIENTS: &[&str] = &[
    "scipy",
    "matplotlib",
    "shapely",
    "geopandas",
    "meshio",
    "pyvista",
    "scikit-fem",
    "xugrid",
    "netCDF4",
    "flopy",
    "triangle",
    "tqdm",
    "mypy",
    "pyright",
];

/// The docstrings that can be run without the clients, as pytest's `-k` has it: that of the
/// Laplacian needs scipy.
const NUMPY_ALONE: &str = "not laplacian";

/// Unpacks an archive. Its files have one time in all of them, by which cargo would take what it made of the
/// last one for fresh: they get that of now.
const UNPACK: &str = "
import os, sys, tarfile
with tarfile.open(sys.argv[1]) as sdist:
    sdist.extractall(sys.argv[2])
    for name in sdist.getnames():
        os.utime(os.path.join(sys.argv[2], name))
";

/// Builds the wheel and the source distribution.
pub(crate) fn wheel() -> Outcome {
    let Some(python) = interpreters().pop() else {
        return Err("no Python of 3.10 or later".into());
    };
    let package = Package::new();
    let tools = package.environment("build", &python)?;
    build(&package, &tools).map(|built| {
        for file in built {
            eprintln!("wheel: {}", file.display());
        }
    })
}

/// Lints and builds the package, and tests it in two environments; says so and does nothing
/// where there is no Python.
pub(crate) fn test() -> Outcome {
    let mut pythons = interpreters();
    let Some(newest) = pythons.pop() else {
        eprintln!("python: skipped, there is no Python of 3.10 or later");
        return Ok(());
    };
    // The oldest version is where what is too new shows.
    let oldest = pythons.into_iter().next().unwrap_or_else(|| newest.clone());
    let package = Package::new();
    package.lint()?;
    let main = package.environment("main", &newest)?;
    let other = package.environment("other", &oldest)?;
    let [wheel, sdist] = build(&package, &main)?;
    let sdist = package.build_sdist(&other, &package.unpack(&main, &sdist)?)?;
    main.install("the clients", CLIENTS);
    for (environment, docstrings) in [(&main, ""), (&other, NUMPY_ALONE)] {
        environment.pip(TOOLS)?;
        for (what, file) in [("the sdist", &sdist), ("the wheel", &wheel)] {
            environment.replace(what, file)?;
            environment.test(&package, docstrings)?;
        }
    }
    main.check_types(&package)
}

/// Where things are.
struct Package {
    source: PathBuf,
    target: PathBuf,
}

impl Package {
    fn new() -> Self {
        let root = tidy::root();
        let target = env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), PathBuf::from);
        Self { source: root.join("python"), target }
    }

    /// Lints the compiled half, which no command for the workspace does.
    fn lint(&self) -> Outcome {
        let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        let mut clippy = Command::new(cargo);
        clippy.args(["clippy", "--quiet", "--locked", "--target-dir"]).arg(&self.target);
        run(clippy.args(["--", "-D", "warnings"]).current_dir(&self.source))
    }

    /// The folder in a source distribution, always in the same place, so that what cargo
    /// makes of it is found again.
    fn unpack(&self, tools: &Environment, sdist: &Path) -> Result<PathBuf, Box<dyn std::error::Error>> {
        let folder = self.target.join("python").join("sdist");
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder)?;
        let [from, to] = [sdist, &folder].map(|path| path.display().to_string());
        tools.run("python", &["-c", UNPACK, &from, &to])?;
        let mut entries = fs::read_dir(&folder)?;
        entries.next().map_or_else(|| Err("the sdist is empty".into()), |entry| Ok(entry?.path()))
    }

    /// The wheel that pip makes of the source distribution. One is for all Pythons, as the other
    /// wheel is.
    fn build_sdist(&self, tools: &Environment, source: &Path) -> Result<PathBuf, Box<dyn std::error::Error>> {
        let folder = self.target.join("python").join("from-sdist");
        let _ = fs::remove_dir_all(&folder);
        let begun = Instant::now();
        let [source, to] = [source, &folder].map(|path| path.display().to_string());
        let wheel = ["-m", "pip", "wheel", "-q", "--disable-pip-version-check", "--no-deps", "--wheel-dir"];
        tools.run("python", &[&wheel[..], &[&to, &source]].concat())?;
        eprintln!("python: built the sdist in {:.0} s", begun.elapsed().as_secs_f64());
        let mut entries = fs::read_dir(&folder)?;
        entries.next().map_or_else(|| Err("pip made no wheel of the sdist".into()), |entry| Ok(entry?.path()))
    }

    /// A virtual environment, made anew if it is not of this Python.
    fn environment(&self, name: &str, python: &Path) -> Result<Environment, Box<dyn std::error::Error>> {
        let folder = self.target.join("python").join(name);
        let stamp = folder.join("made-by");
        let made_by = python.display().to_string();
        if fs::read_to_string(&stamp).ok().as_ref() != Some(&made_by) {
            fs::create_dir_all(&folder)?;
            run(Command::new(python).args(["-m", "venv", "--clear"]).arg(&folder))?;
            fs::write(stamp, made_by)?;
        }
        let programs = folder.join(if cfg!(windows) { "Scripts" } else { "bin" });
        Ok(Environment { folder, programs, target: self.target.clone() })
    }
}

/// The wheel, and the source distribution.
fn build(package: &Package, tools: &Environment) -> Result<[PathBuf; 2], Box<dyn std::error::Error>> {
    tools.pip(&["--upgrade", "pip"])?;
    tools.pip(&BUILDERS[..1])?;
    let zig = cfg!(target_os = "linux") && tools.install("zig", &BUILDERS[1..]);
    let out = package.target.join("wheels");
    let _ = fs::remove_dir_all(&out);
    let manifest = package.source.join("Cargo.toml").display().to_string();
    let folder = out.display().to_string();
    let begun = Instant::now();
    let mut arguments =
        vec!["build", "--release", "--locked", "--manifest-path", &manifest, "--out", &folder];
    if zig {
        arguments.extend(["--zig", "--compatibility", "manylinux2014"]);
    }
    tools.run("maturin", &arguments)?;
    eprintln!("python: built the wheel in {:.0} s", begun.elapsed().as_secs_f64());
    tools.run("maturin", &["sdist", "--manifest-path", &manifest, "--out", &folder])?;
    let mut built = Vec::new();
    for entry in fs::read_dir(&out)? {
        built.push(entry?.path());
    }
    built.sort_by_key(|path| path.extension().is_none_or(|e| e != "whl"));
    built.try_into().map_err(|_| format!("{folder} does not hold a wheel and an sdist").into())
}

/// A virtual environment.
struct Environment {
    folder: PathBuf,
    programs: PathBuf,
    target: PathBuf,
}

impl Environment {
    /// A program of it, which finds others of it first, and works outside of the sources.
    fn command(&self, program: &str) -> Command {
        let mut paths = vec![self.programs.clone()];
        paths.extend(env::split_paths(&env::var_os("PATH").unwrap_or_default()));
        let mut command = Command::new(self.programs.join(program));
        if let Ok(paths) = env::join_paths(paths) {
            command.env("PATH", paths);
        }
        command
            .current_dir(&self.folder)
            .env("VIRTUAL_ENV", &self.folder)
            .env("CARGO_TARGET_DIR", &self.target)
            .env("MPLBACKEND", "agg")
            .env("PYTHONDONTWRITEBYTECODE", "1")
            .env_remove("PYTHONPATH");
        command
    }

    fn run(&self, program: &str, arguments: &[&str]) -> Outcome {
        run(self.command(program).args(arguments))
    }

    fn pip(&self, arguments: &[&str]) -> Outcome {
        self.run(
            "python",
            &[&["-m", "pip", "install", "-q", "--disable-pip-version-check"], arguments].concat(),
        )
    }

    /// Installs packages, one by one if they do not install together. Whether all did.
    fn install(&self, what: &str, packages: &[&str]) -> bool {
        let begun = Instant::now();
        let mut all = self.pip(packages).is_ok();
        if !all {
            all = true;
            for package in packages {
                if self.pip(&[package]).is_err() {
                    eprintln!("python: {package} does not install: what needs it is skipped");
                    all = false;
                }
            }
        }
        eprintln!("python: {what} in {:.0} s", begun.elapsed().as_secs_f64());
        all
    }

    /// Installs hexdel from a wheel, whether or not it is there.
    fn replace(&self, what: &str, with: &Path) -> Outcome {
        let begun = Instant::now();
        self.pip(&["--force-reinstall", "--no-deps", &with.display().to_string()])?;
        eprintln!("python: {what} in {:.0} s, in {}", begun.elapsed().as_secs_f64(), self.folder.display());
        Ok(())
    }

    /// All tests, and the examples in the docstrings chosen, of what is installed.
    fn test(&self, package: &Package, docstrings: &str) -> Outcome {
        let begun = Instant::now();
        let config = package.source.join("pyproject.toml").display().to_string();
        let tests = package.source.join("tests").display().to_string();
        let common = ["-q", "-p", "no:cacheprovider", "-c", &config, "-rs"];
        self.run("pytest", &[&common[..], &["--durations=5", &tests]].concat())?;
        self.run(
            "pytest",
            &[&common[..], &["--doctest-modules", "--pyargs", "hexdel", "-k", docstrings]].concat(),
        )?;
        eprintln!("python: tests in {:.0} s", begun.elapsed().as_secs_f64());
        Ok(())
    }

    /// Checks types of the package and the examples, with the checkers that are installed.
    fn check_types(&self, package: &Package) -> Outcome {
        let [sources, examples, config] = ["hexdel", "examples", "pyproject.toml"]
            .map(|name| package.source.join(name).display().to_string());
        if self.programs.join("mypy").exists() {
            self.run("mypy", &["--config-file", &config, "--cache-dir", "mypy", &sources, &examples])?;
        }
        if self.programs.join("pyright").exists() {
            let python = self.programs.join("python").display().to_string();
            self.run("pyright", &["-p", &config, "--pythonpath", &python])?;
        }
        Ok(())
    }
}

fn run(command: &mut Command) -> Outcome {
    let status = command.status().map_err(|error| format!("{}: {error}", command.get_program().display()))?;
    if status.success() { Ok(()) } else { Err(format!("{command:?} failed ({status})").into()) }
}

/// Interpreters of 3.10 and later, the oldest first: on the path, and those of pyenv.
fn interpreters() -> Vec<PathBuf> {
    let mut found = Vec::new();
    for minor in MINORS {
        let name = format!("python3.{minor}");
        let of_pyenv =
            env::home_dir().map(|home| home.join(".pyenv/versions")).into_iter().flat_map(|folder| {
                let versions = fs::read_dir(folder).into_iter().flatten().flatten();
                let mut versions: Vec<PathBuf> = versions.map(|entry| entry.path()).collect();
                versions.sort();
                versions.into_iter().map(|version| version.join("bin/python3"))
            });
        let candidates = std::iter::once(PathBuf::from(&name)).chain(of_pyenv);
        found.extend(candidates.into_iter().find(|python| version(python) == Some(minor)));
    }
    if found.is_empty() && version(Path::new("python3")).is_some_and(|minor| minor >= *MINORS.start()) {
        found.push(PathBuf::from("python3"));
    }
    found
}

/// The minor version of an interpreter that works and makes environments.
fn version(python: &Path) -> Option<u32> {
    let code = "import sys, venv, ensurepip; print(sys.version_info[1] if sys.version_info[0] == 3 else 0)";
    let output = Command::new(python).args(["-c", code]).stderr(Stdio::null()).output().ok()?;
    if !output.status.success() {
        return None;
    }
    String::from_utf8(output.stdout).ok()?.trim().parse().ok()
}
