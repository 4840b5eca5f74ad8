//! The libraries and the program on Windows: MinGW builds them, and Wine runs their tests, the program beside that of Linux, and
//! `conform` on lavapipe. For macOS and Visual C++ the compiler checks them.

use crate::{
    at, cache, cargo, emptied, languages, output, packages, program, repository, run as run_command, setup,
    target,
};
use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::thread;

/// The target of Windows that Debian has a linker for.
const WINDOWS: &str = "x86_64-pc-windows-gnu";
/// Targets whose programs nothing runs here.
const CHECKED: [&str; 2] = ["aarch64-apple-darwin", "x86_64-pc-windows-msvc"];

pub const GCC: &str = "x86_64-w64-mingw32-gcc";
const SOURCES: &str = "xtask/src/windows";

/// Command lines that do the same on both systems: bytes, messages, status and files. `<` gives the vectors as standard input.
const SAME: &[&str] = &[
    "codecs",
    "choose --max-error 0.1 --json -",
    "shader --language hlsl --codec oct24p",
    "encode --codec oct32p in.bin out.codes",
    "decode --codec oct32p out.codes back.npy",
    // An output that is there.
    "encode --codec oct16p in.bin out.codes",
    "encode --codec frame32 torus.glb torus.frames",
    "encode --codec oct24p lines.obj nörmals_✓_日本.uvec",
    "decode nörmals_✓_日本.uvec zurück_漢.npy",
    "decode --codec oct16p fehlt_✓.codes x.npy",
    "encode --codec oct32p in.bin -",
    "< encode --codec oct32p - -",
    "< encode --codec oct32p - piped.codes",
    "error --codec oct24p,ico24 in.bin",
    "error --codec oct16 --json - in.bin",
    // The input as the output.
    "decode --codec oct16p out.codes out.codes",
    "decode --codec oct16p out.codes ./out.codes",
    "encode --codec oct32p in.bin none/x.codes",
];

/// `cargo xtask windows`.
pub fn run(arguments: &[String]) -> Result<(), String> {
    if let Some(unknown) = arguments.first() {
        return Err(format!("windows takes no {unknown}"));
    }
    setup::packages(&[&languages::FOR_FXC[..], &["xauth"]].concat())?;
    output(Command::new("rustup").args(["target", "add", WINDOWS]).args(CHECKED))?;
    let published = packages::names().chain(["unitvec-c"]).flat_map(|name| ["--package", name]);
    let published: Vec<&str> = published.collect();
    println!(
        "xtask: macOS and Visual C++, which nothing runs here: the compiler checks all libraries and the program"
    );
    let targets = CHECKED.iter().flat_map(|target| ["--target", target]);
    run_command(cargo(&["check", "--quiet"]).args(targets).args(&published))?;
    let linux = program()?;
    let wine = Wine::new(cache("windows")?)?;
    println!("xtask: the libraries' tests and the program, built for Windows");
    run_command(wine.set(cargo(&["test", "--target", WINDOWS]).args(&published)))?;
    run_command(wine.set(&mut cargo(&["build", "--target", WINDOWS, "--package", "unitvec-host"])))?;
    let windows = target()?.join(WINDOWS).join("debug/unitvec.exe");
    Checks::new(&wine, &linux, &windows)?.run()?;
    println!("xtask: conform by Wine's Vulkan");
    wine.stop();
    let mut conform = Command::new("xvfb-run");
    // Drivers complain without such a folder.
    conform.env("XDG_RUNTIME_DIR", &wine.folder).args(["--auto-servernum", "wine"]).arg(&windows);
    conform.args(["conform", "--device", "lavapipe", "--count", "4096"]);
    run_command(wine.set(&mut conform))
}

/// Wine with a folder of its own.
pub struct Wine {
    folder: PathBuf,
}

impl Wine {
    pub fn new(folder: PathBuf) -> Result<Self, String> {
        let wine = Self { folder };
        let prefix = wine.folder.join("prefix");
        let library = prefix.join("drive_c/windows/system32/bcryptprimitives.dll");
        fs::create_dir_all(&prefix).map_err(at(&prefix))?;
        // Services live as long as the server. Those that a program starts write into its errors.
        for line in [["wineserver", "--persistent"].as_slice(), &["wine", "wineboot", "--init"]] {
            let mut command = Command::new(line[0]);
            command.args(&line[1..]).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
            run_command(wine.set(&mut command))?;
        }
        if !library.exists() {
            gcc("prng.c", &["-shared", "-ladvapi32"], &library)?;
        }
        gcc("interrupt.c", &[], &wine.folder.join("interrupt.exe"))?;
        Ok(wine)
    }

    /// Sets the variables of Wine, and those by which cargo links for Windows and runs under Wine.
    pub fn set<'a>(&self, command: &'a mut Command) -> &'a mut Command {
        command.env("WINEPREFIX", self.folder.join("prefix")).env("WINEDEBUG", "-all");
        // Without menus, and without questions for packages that only other programs need.
        command.env("WINEDLLOVERRIDES", "winemenubuilder.exe,mscoree,mshtml=");
        command.env("CARGO_TARGET_X86_64_PC_WINDOWS_GNU_LINKER", GCC);
        command.env("CARGO_TARGET_X86_64_PC_WINDOWS_GNU_RUNNER", "wine")
    }

    /// Ends what Wine leaves running, which would keep the next program from a screen.
    fn stop(&self) {
        for option in ["--kill", "--wait"] {
            let _ = self.set(Command::new("wineserver").arg(option)).output();
        }
    }
}

impl Drop for Wine {
    fn drop(&mut self) {
        self.stop();
    }
}

fn gcc(source: &str, options: &[&str], to: &Path) -> Result<(), String> {
    let mut gcc = Command::new(GCC);
    gcc.args(["-O1", "-Wall", "-Wextra", "-Werror", "-o"]).arg(to);
    output(gcc.arg(repository().join(SOURCES).join(source)).args(options)).map(drop)
}

/// Files of a folder by their names, and their contents.
type Files = BTreeMap<String, Vec<u8>>;

/// Status, standard output and standard error of a command, and the files that it leaves.
type Outcome = (Option<i32>, Vec<u8>, String, Files);

/// Checks of the program in two folders of the same files: of Linux and of Windows.
struct Checks<'a> {
    wine: &'a Wine,
    linux: &'a Path,
    windows: &'a Path,
    folders: [PathBuf; 2],
    vectors: Vec<u8>,
    passed: usize,
    failed: usize,
}

impl<'a> Checks<'a> {
    fn new(wine: &'a Wine, linux: &'a Path, windows: &'a Path) -> Result<Self, String> {
        let data = repository().join("host/mesh/data");
        let [first, second] = ["linux", "windows"].map(|name| emptied(wine.folder.join(name)));
        let folders = [first?, second?];
        let lines = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvn 0 1 0\nf 1//1 2//2 3//1\n".replace('\n', "\r\n");
        for folder in &folders {
            output(
                Command::new(linux).arg("normals").arg(data.join("bunny.obj")).arg(folder.join("in.bin")),
            )?;
            fs::copy(data.join("torus.glb"), folder.join("torus.glb")).map_err(at(folder))?;
            fs::write(folder.join("lines.obj"), &lines).map_err(at(folder))?;
        }
        let vectors = fs::read(folders[0].join("in.bin")).map_err(at(&folders[0]))?;
        Ok(Self { wine, linux, windows, folders, vectors, passed: 0, failed: 0 })
    }

    fn run(mut self) -> Result<(), String> {
        for line in SAME {
            let (here, there) = (self.outcome(line, 0)?, self.outcome(line, 1)?);
            self.note(line, difference(&here, &there));
        }
        let before = self.outcome("codecs", 1)?.3;
        self.devices(&before)?;
        self.files(&before)?;
        self.interrupted(&before)?;
        let Self { passed, failed, .. } = self;
        println!("xtask: the program on Windows: {passed} checks hold");
        if failed == 0 { Ok(()) } else { Err(format!("{failed} checks of the program fail, see above")) }
    }

    /// Reserved names are devices in any folder. There is no console here that `CON` could be.
    fn devices(&mut self, before: &Files) -> Result<(), String> {
        for name in ["NUL", "nul", r"C:\NUL", r"\\.\NUL"] {
            self.ends(&format!("encode --codec oct32p in.bin {name}"), 0, "", before)?;
            self.ends(&format!("error --codec oct32p --raw {name}"), 0, "", before)?;
        }
        for line in ["encode --codec oct32p in.bin CON", "error --codec oct32p --raw CON"] {
            self.ends(line, 1, "CON: Invalid handle", before)?;
        }
        self.ends(r"encode --codec oct32p in.bin \\.\pipe\none", 1, r"cannot write \\.\pipe\none", before)
    }

    /// What only Windows refuses: an output that is read-only, names that differ in case alone; and paths beyond its 260 characters.
    fn files(&mut self, before: &Files) -> Result<(), String> {
        self.ends("decode --codec oct16p out.codes OUT.CODES", 2, "is the input", before)?;
        self.ends("encode --codec oct32p in.bin a|b?.codes", 1, "Invalid name", before)?;
        let output = self.folders[1].join("out.codes");
        let permissions = output.metadata().map_err(at(&output))?.permissions();
        let mut read_only = permissions.clone();
        read_only.set_readonly(true);
        fs::set_permissions(&output, read_only).map_err(at(&output))?;
        self.ends("encode --codec oct32p in.bin out.codes", 1, "out.codes: access denied", before)?;
        fs::set_permissions(&output, permissions).map_err(at(&output))?;

        let folder = self.folders[1].join(["long"; 40].join("_")).join(["name"; 40].join("_"));
        fs::create_dir_all(&folder).map_err(at(&folder))?;
        let on_windows = format!("Z:{}", folder.display()).replace('/', "\\");
        let line = format!(r"encode --codec oct16p in.bin {on_windows}\new.codes");
        for _ in ["new", "replaced"] {
            self.ends(&line, 0, "", before)?;
        }
        let same = fs::read(folder.join("new.codes")).ok().as_ref() == before.get("out.codes");
        self.note("codes at a long path", (!same).then(|| "other bytes".to_owned()));
        self.ends(
            &format!(r"decode --codec oct16p {on_windows}\new.codes {on_windows}\back.npy"),
            0,
            "",
            before,
        )
    }

    /// Ctrl-C, while the program writes a file of gigabytes, leaves no file of its own.
    fn interrupted(&mut self, before: &Files) -> Result<(), String> {
        let huge = self.folders[1].join("huge.f32");
        File::create(&huge).and_then(|file| file.set_len(12 << 33)).map_err(at(&huge))?;
        let line = format!("{} encode --codec oct32p huge.f32 huge.codes", self.windows.display());
        let mut interrupt = Command::new("wine");
        interrupt.arg(self.wine.folder.join("interrupt.exe")).arg(line).current_dir(&self.folders[1]);
        let status = self.wine.set(&mut interrupt).status().map_err(at(&huge))?;
        fs::remove_file(&huge).map_err(at(&huge))?;
        let left = files(&self.folders[1])?;
        let is_right = status.code() == Some(130) && left == *before;
        let names = || left.keys().map(String::as_str).collect::<Vec<_>>().join(" ");
        self.note("Ctrl-C", (!is_right).then(|| format!("it ended with {status} and left {}", names())));
        Ok(())
    }

    /// Runs a line on Windows, which must end so, say this, and leave these files.
    fn ends(&mut self, line: &str, status: i32, word: &str, left: &Files) -> Result<(), String> {
        let (code, _, said, files) = self.outcome(line, 1)?;
        let is_right = code == Some(status) && said.contains(word) && files == *left;
        self.note(line, (!is_right).then(|| format!("it ended with {code:?}: {said}")));
        Ok(())
    }

    fn note(&mut self, title: &str, fault: Option<String>) {
        match fault {
            None => self.passed += 1,
            Some(fault) => {
                self.failed += 1;
                println!("xtask: FAIL: {title}: {fault}");
            }
        }
    }

    /// Runs a line of [`SAME`] or of its kind, in the folder of Linux or of Windows.
    fn outcome(&self, line: &str, system: usize) -> Result<Outcome, String> {
        let (takes_input, line) = line.strip_prefix("< ").map_or((false, line), |line| (true, line));
        let folder = &self.folders[system];
        let mut command = Command::new(if system == 0 { self.linux } else { Path::new("wine") });
        command.args((system == 1).then_some(self.windows)).args(line.split(' ')).current_dir(folder);
        command.stdin(if takes_input { Stdio::piped() } else { Stdio::null() });
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = self.wine.set(&mut command).spawn().map_err(at(folder))?;
        let output = thread::scope(|scope| {
            if let Some(mut stdin) = child.stdin.take() {
                scope.spawn(move || stdin.write_all(&self.vectors));
            }
            child.wait_with_output().map_err(at(folder))
        })?;
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        Ok((output.status.code(), output.stdout, said, files(folder)?))
    }
}

/// The difference between Linux and Windows, if there is one.
fn difference(here: &Outcome, there: &Outcome) -> Option<String> {
    let differing = || {
        let names =
            here.3.keys().chain(there.3.keys()).filter(|name| here.3.get(*name) != there.3.get(*name));
        names.map(String::as_str).collect::<Vec<_>>().join(" ")
    };
    if here.0 != there.0 || here.2 != there.2 {
        return Some(format!(
            "ended with {:?}, not {:?}, and said: {}not: {}",
            there.0, here.0, there.2, here.2
        ));
    }
    let is_same = here.1 == there.1 && here.3 == there.3;
    (!is_same).then(|| format!("other bytes on the standard output, or in: {}", differing()))
}

/// The files of a folder, without those below it.
fn files(folder: &Path) -> Result<Files, String> {
    let paths = fs::read_dir(folder).map_err(at(folder))?.filter_map(|entry| Some(entry.ok()?.path()));
    let read = |path: PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        fs::read(&path).map_err(at(&path)).map(|bytes| (name, bytes))
    };
    paths.filter(|path| path.is_file()).map(read).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_are_named() {
        let outcome = |status, printed: &str, said: &str, bytes: &[u8]| -> Outcome {
            (Some(status), printed.into(), said.to_owned(), [("a".to_owned(), bytes.to_vec())].into())
        };
        let here = outcome(0, "1", "", b"1");
        assert_eq!(difference(&here, &here), None);
        for (there, named) in [
            (outcome(1, "1", "", b"1"), "Some(1), not Some(0)"),
            (outcome(0, "1", "other error", b"1"), "other error"),
            (outcome(0, "2", "", b"1"), "standard output"),
            (outcome(0, "1", "", b"2"), "in: a"),
            ((Some(0), b"1".to_vec(), String::new(), Files::new()), "in: a"),
        ] {
            let told = difference(&here, &there).unwrap();
            assert!(told.contains(named), "{told}");
        }
    }
}
