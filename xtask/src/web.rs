//! `cargo xtask web`: the library for browsers and Node, as users get it: an npm package in
//! `web/package`, and the page in `web/dist`.
//!
//! What is compiled is below `target/web`; npm's packages are in `web/node_modules`, of the
//! versions in the lockfile. Missing parts of the toolchain are fetched: the target of the
//! compiler by rustup or else, as root, from Debian, and for the tests a browser from Debian.
//! Where they cannot be had the task says so: `cargo xtask web` fails, and
//! `cargo xtask web --test` is skipped.

use crate::Outcome;
use crate::tidy;
use std::env;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

/// What the library is compiled for.
pub(crate) const TARGET: &str = "wasm32-unknown-unknown";

/// The oldest version of Node that will do.
const NODE: u32 = 20;

/// Names that the browser goes by.
const BROWSERS: &[&str] = &["chromium", "chromium-browser", "google-chrome"];

/// Debian's compiler with the sources of its standard library, which has no other target
/// compiled. The linker's name has a version, which moves.
const DEBIAN: &[&str] = &["rustc-web", "cargo-web", "rust-web-src"];

/// What the compressed module may take, bytes.
const MOST: u64 = 1_000_000;

/// Builds the package and the page.
pub(crate) fn build() -> Outcome {
    let web = Web::new();
    match web.tools()? {
        Ok(compiler) => web.build(&compiler),
        Err(missing) => Err(missing.into()),
    }
}

/// Lints, builds and tests; says so and does nothing where the tools cannot be had.
pub(crate) fn test() -> Outcome {
    let web = Web::new();
    let compiler = match web.tools()? {
        Ok(compiler) => compiler,
        Err(missing) => {
            eprintln!("web: skipped, {missing}");
            return Ok(());
        }
    };
    web.lint(&compiler)?;
    web.build(&compiler)?;
    let program = web.program()?;
    web.node_test("package.test.mjs", &program, None)?;
    let Some(browser) = browser() else {
        eprintln!("web: there is no Chromium: the tests of the page are skipped");
        return Ok(());
    };
    web.node_test("page.test.mjs", &program, Some(&browser))
}

/// Where things are.
struct Web {
    source: PathBuf,
    /// What cargo compiles.
    target: PathBuf,
}

/// What compiles for the target.
enum Compiler {
    /// The toolchain that this task is run with.
    Own,
    /// Debian's, with its linker.
    Debian(PathBuf),
}

/// A tool, or which one is missing.
type Found<T> = Result<Result<T, String>, Box<dyn std::error::Error>>;

impl Web {
    fn new() -> Self {
        let root = tidy::root();
        let target = env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), PathBuf::from);
        Self { source: root.join("web"), target: target.join("web") }
    }

    /// The compiler, after a look at all other tools.
    fn tools(&self) -> Found<Compiler> {
        if node_version().is_none_or(|version| version < NODE) {
            return Ok(Err(format!("there is no Node of version {NODE} or later")));
        }
        if !succeeds(Command::new("npm").arg("--version")) {
            return Ok(Err("there is no npm".into()));
        }
        if !self.install_packages()? {
            return Ok(Err("npm does not install the packages of web/package-lock.json".into()));
        }
        Ok(compiler().ok_or_else(|| format!("there is no Rust compiler for {TARGET}")))
    }

    /// npm's packages, unless they are there. Whether they are.
    fn install_packages(&self) -> Result<bool, Box<dyn std::error::Error>> {
        let wanted = fs::read_to_string(self.source.join("package-lock.json"))?;
        let stamp = self.source.join("node_modules/.installed");
        if fs::read_to_string(&stamp).is_ok_and(|installed| installed == wanted) {
            return Ok(true);
        }
        let mut npm = Command::new("npm");
        npm.args(["ci", "--ignore-scripts", "--no-audit", "--no-fund"]).current_dir(&self.source);
        if !npm.status()?.success() {
            return Ok(false);
        }
        fs::write(stamp, wanted)?;
        Ok(true)
    }

    /// Checks format and lints of the two crates.
    fn lint(&self, compiler: &Compiler) -> Outcome {
        for folder in ["crate", "bind"] {
            run(cargo().args(["fmt", "--check"]).current_dir(self.source.join(folder)))?;
        }
        if !matches!(compiler, Compiler::Own) {
            eprintln!("web: clippy is skipped, which Debian's compiler has not");
            return Ok(());
        }
        let mut clippy = cargo();
        clippy.args(["clippy", "--quiet", "--release", "--locked", "--target", TARGET, "--target-dir"]);
        clippy.arg(&self.target).args(["--", "-D", "warnings"]);
        run(clippy.current_dir(self.source.join("crate")))
    }

    fn build(&self, compiler: &Compiler) -> Outcome {
        let begun = Instant::now();
        let mut command = compiler.command();
        command.args(["--release", "--locked", "--target", TARGET, "--target-dir"]).arg(&self.target);
        run(command.current_dir(self.source.join("crate")))?;
        let module = self.target.join(TARGET).join("release/hexdel_web.wasm");
        let folder = self.source.join("package/wasm");
        fs::create_dir_all(&folder)?;
        let mut bind = cargo();
        bind.args(["run", "--quiet", "--locked", "--target-dir"]).arg(self.target.join("bind")).arg("--");
        run(bind.args([&module, &folder]).current_dir(self.source.join("bind")))?;
        run(Command::new("node").arg("build.mjs").current_dir(&self.source))?;
        weigh(&folder.join("hexdel_web_bg.wasm"))?;
        eprintln!("web: built web/package and web/dist in {:.0} s", begun.elapsed().as_secs_f64());
        Ok(())
    }

    /// The program, whose files those of the package must equal.
    fn program(&self) -> Result<PathBuf, Box<dyn std::error::Error>> {
        let target = self.target.parent().unwrap_or(&self.target);
        let mut build = cargo();
        // With the features of the whole workspace, as its tests have compiled it.
        build
            .args(["build", "--quiet", "--locked", "--workspace", "--bin", "hexdel", "--target-dir"])
            .arg(target);
        run(build.current_dir(tidy::root()))?;
        Ok(target.join("debug").join(format!("hexdel{}", env::consts::EXE_SUFFIX)))
    }

    fn node_test(&self, name: &str, program: &Path, browser: Option<&Path>) -> Outcome {
        let begun = Instant::now();
        let mut node = Command::new("node");
        node.args(["--test", "--test-reporter=spec"]).arg(self.source.join("tests").join(name));
        node.env("HEXDEL", program).current_dir(&self.source);
        if let Some(browser) = browser {
            node.env("CHROMIUM", browser);
        }
        run(&mut node)?;
        eprintln!("web: {name} in {:.0} s", begun.elapsed().as_secs_f64());
        Ok(())
    }
}

impl Compiler {
    /// `cargo build`, up to its options.
    fn command(&self) -> Command {
        match self {
            Self::Own => {
                let mut command = cargo();
                command.arg("build");
                command
            }
            Self::Debian(linker) => {
                let mut command = Command::new("/usr/bin/cargo");
                command.args(["build", "-Zbuild-std=std,panic_abort"]);
                command.env("RUSTC", "/usr/bin/rustc").env("RUSTC_BOOTSTRAP", "1");
                command.env("CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER", linker);
                command
            }
        }
    }
}

/// Says how large the module is, and fails if it is too large.
fn weigh(module: &Path) -> Outcome {
    let script = "process.stdout.write(String(zlib.gzipSync(fs.readFileSync(process.argv[1]), \
                  { level: 9 }).length))";
    let output = Command::new("node").args(["-e", script]).arg(module).output()?;
    let compressed: u64 = String::from_utf8(output.stdout)?.trim().parse()?;
    let whole = fs::metadata(module)?.len();
    eprintln!("web: the module has {whole} bytes, compressed {compressed}");
    if compressed > MOST {
        return Err(format!("the compressed module has {compressed} bytes, more than {MOST}").into());
    }
    Ok(())
}

/// Cargo as this task was called by, so that a chosen toolchain stays chosen.
fn cargo() -> Command {
    Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
}

/// A compiler that has the target, or that gets it.
fn compiler() -> Option<Compiler> {
    if has_target() {
        return Some(Compiler::Own);
    }
    if let Some(linker) = debian_linker() {
        return Some(Compiler::Debian(linker));
    }
    eprintln!("web: the compiler has no target {TARGET}: rustup is asked for it");
    if succeeds(Command::new("rustup").args(["target", "add", TARGET])) && has_target() {
        return Some(Compiler::Own);
    }
    let linkers = ["--names-only", "^lld-[0-9]+$"];
    install_from_debian(DEBIAN, Some(&linkers));
    debian_linker().map(Compiler::Debian)
}

/// Whether the compiler's own folder has the target's standard library.
pub(crate) fn has_target() -> bool {
    let rustc = env::var_os("RUSTC").unwrap_or_else(|| OsString::from("rustc"));
    let output = Command::new(rustc).args(["--print", "target-libdir", "--target", TARGET]).output();
    output.is_ok_and(|output| Path::new(String::from_utf8_lossy(&output.stdout).trim()).is_dir())
}

/// The linker for Debian's compiler, if both are installed, and the sources.
fn debian_linker() -> Option<PathBuf> {
    let output = Command::new("/usr/bin/rustc").args(["--print", "sysroot"]).output().ok()?;
    let sysroot = PathBuf::from(String::from_utf8(output.stdout).ok()?.trim());
    let sources = sysroot.join("lib/rustlib/src/rust/library/std/Cargo.toml");
    if !sources.exists() || !Path::new("/usr/bin/cargo").exists() {
        return None;
    }
    let folders = fs::read_dir("/usr/lib").ok()?.flatten().map(|entry| entry.path());
    let mut linkers: Vec<PathBuf> =
        folders.map(|folder| folder.join("bin/wasm-ld")).filter(|linker| linker.exists()).collect();
    linkers.sort();
    linkers.pop()
}

/// The browser of the tests, from Debian if it is missing.
fn browser() -> Option<PathBuf> {
    let find = || {
        let given = env::var_os("CHROMIUM").map(PathBuf::from);
        given.or_else(|| BROWSERS.iter().find_map(|name| on_path(name)))
    };
    find().or_else(|| {
        install_from_debian(&BROWSERS[..1], None);
        find()
    })
}

/// Installs packages of Debian as root, and the last one that a search finds. Who calls looks
/// whether they are there.
fn install_from_debian(packages: &[&str], search: Option<&[&str]>) {
    let root = Command::new("id").arg("-u").output().is_ok_and(|id| id.stdout == b"0\n");
    if !root || on_path("apt-get").is_none() {
        return;
    }
    eprintln!("web: installing {} from Debian", packages.join(", "));
    succeeds(Command::new("apt-get").args(["update", "-qq"]));
    let mut install = Command::new("apt-get");
    install.args(["install", "-qq", "-y", "--no-install-recommends"]).args(packages);
    if let Some(search) = search {
        let found = Command::new("apt-cache").arg("search").args(search).output();
        let found =
            found.map(|found| String::from_utf8_lossy(&found.stdout).into_owned()).unwrap_or_default();
        let names = found.lines().filter_map(|line| line.split(' ').next());
        install.args(names.max_by_key(|name| (name.len(), *name)));
    }
    succeeds(install.env("DEBIAN_FRONTEND", "noninteractive"));
}

fn on_path(program: &str) -> Option<PathBuf> {
    let paths = env::var_os("PATH")?;
    env::split_paths(&paths).map(|folder| folder.join(program)).find(|path| path.is_file())
}

fn node_version() -> Option<u32> {
    let output = Command::new("node").arg("--version").output().ok()?;
    let version = String::from_utf8(output.stdout).ok()?;
    version.trim().trim_start_matches('v').split('.').next()?.parse().ok()
}

fn succeeds(command: &mut Command) -> bool {
    command.stdout(Stdio::null()).status().is_ok_and(|status| status.success())
}

fn run(command: &mut Command) -> Outcome {
    let status = command.status().map_err(|error| format!("{}: {error}", command.get_program().display()))?;
    if status.success() { Ok(()) } else { Err(format!("{command:?} failed ({status})").into()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tool_has_the_version_of_what_it_finishes() {
        let root = tidy::root().join("web");
        let version = |file: &str, name: &str| {
            let manifest = fs::read_to_string(root.join(file)).unwrap();
            let line = manifest.lines().find(|line| line.starts_with(&format!("{name} = \"="))).unwrap();
            line.split('"').nth(1).unwrap().to_owned()
        };
        let of_tool = version("bind/Cargo.toml", "wasm-bindgen-cli-support");
        assert_eq!(version("crate/Cargo.toml", "wasm-bindgen"), of_tool);
    }

    #[test]
    fn the_package_has_the_version_of_the_library() {
        let manifest = fs::read_to_string(tidy::root().join("web/package/package.json")).unwrap();
        assert!(manifest.contains(&format!("\"version\": \"{}\"", env!("CARGO_PKG_VERSION"))));
    }
}
