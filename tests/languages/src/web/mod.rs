//! WGSL and GLSL ES by the implementations of browsers: Dawn in Node.js, and pages in Chromium. A server on loopback gives
//! them their jobs and takes their results.

use crate::cases::COUNT;
use crate::job::Job;
use crate::tally::Tally;
use crate::{Result, told, tool};
use serde::Serialize;
use std::ffi::OsString;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};
use tiny_http::{Header, Method, Request, Response, Server};

const FILES: [(&str, &str, &str); 4] = [
    ("/", include_str!("page.html"), "text/html"),
    ("/run.mjs", include_str!("run.mjs"), "text/javascript"),
    ("/webgpu.mjs", include_str!("webgpu.mjs"), "text/javascript"),
    ("/webgl.mjs", include_str!("webgl.mjs"), "text/javascript"),
];

const DAWN: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/src/web/dawn.mjs");

/// The time for which a client may be silent.
const PATIENCE: Duration = Duration::from_secs(120);

/// An implementation of WebGPU or WebGL.
pub enum Client {
    /// Dawn's addon to Node.js, on the driver in this file. Its messages go to the file `said`.
    Dawn { addon: PathBuf, icd: PathBuf, said: PathBuf },
    /// Chromium in this folder, on the SwiftShader that it brings along, with one of the scripts above.
    Chromium { root: PathBuf, script: &'static str, profile: PathBuf },
}

impl Client {
    /// The client's name and version.
    pub fn name(&self) -> String {
        match self {
            // The package's folder has the version in its name.
            Self::Dawn { addon, .. } => {
                let mut folders = addon.iter().map(|name| name.to_string_lossy());
                let version = folders.find_map(|name| name.strip_prefix("webgpu-").map(str::to_owned));
                format!("Dawn of webgpu {}", version.unwrap_or_default())
            }
            Self::Chromium { root, profile, .. } => {
                let version = tool::output(chromium(root, profile).arg("--version"));
                version.unwrap_or_else(|_| "Chromium".to_owned()).trim().to_owned()
            }
        }
    }

    fn command(&self, url: &str) -> Result<Command> {
        Ok(match self {
            Self::Dawn { addon, icd, said } => {
                let said = File::create(said).map_err(|error| format!("{}: {error}", said.display()))?;
                let mut command = Command::new("node");
                command.args([DAWN.as_ref(), addon.as_os_str(), url.as_ref()]);
                command.env("VK_DRIVER_FILES", icd).env("VK_ICD_FILENAMES", icd).stderr(said);
                command
            }
            Self::Chromium { root, script, profile } => {
                let mut command = chromium(root, profile);
                command.arg(format!("{url}/?language={script}")).stdout(Stdio::null()).stderr(Stdio::null());
                command
            }
        })
    }

    /// The end of the client's messages.
    fn last_words(&self) -> String {
        const LINES: usize = 3;
        let Self::Dawn { said, .. } = self else { return String::new() };
        let said = fs::read(said).unwrap_or_default();
        let said = String::from_utf8_lossy(&said);
        let lines: Vec<&str> = said.lines().filter(|line| !line.trim().is_empty()).collect();
        lines[lines.len().saturating_sub(LINES)..].join("; ")
    }
}

/// Chromium with its libraries from `root`, which need not be installed.
fn chromium(root: &Path, profile: &Path) -> Command {
    let libraries = root.join("usr/lib/x86_64-linux-gnu");
    let mut paths = OsString::from(&libraries);
    paths.push(":");
    paths.push(libraries.join("pulseaudio"));
    let mut command = Command::new(root.join("usr/lib/chromium/chromium"));
    command
        .args(["--headless=new", "--no-sandbox", "--no-first-run", "--disable-extensions"])
        .args(["--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader"])
        .args(["--use-angle=swiftshader", "--enable-unsafe-swiftshader"])
        .arg(format!("--user-data-dir={}", profile.display()))
        .env("LD_LIBRARY_PATH", paths);
    command
}

/// A job as clients see it.
#[derive(Serialize)]
struct Told<'a> {
    text: &'a str,
    count: usize,
    read: usize,
    written: usize,
}

/// Compiles and runs. Returns the client's description of its device.
pub fn run(client: &Client, jobs: &[Job<'_>], tally: &mut Tally) -> Result<String> {
    let server = Server::http("127.0.0.1:0").map_err(told)?;
    let mut command = client.command(&format!("http://{}", server.server_addr()))?;
    let program = command.get_program().to_string_lossy().into_owned();
    let mut child = command.spawn().map_err(|error| format!("{program} cannot be started: {error}"))?;
    let device = serve(&server, &mut child, jobs, tally);
    // Chromium does not end by itself.
    let _ = child.kill();
    child.wait().map_err(told)?;
    device.map_err(|error| format!("{}\n{error}", client.last_words()))
}

fn serve(server: &Server, child: &mut Child, jobs: &[Job<'_>], tally: &mut Tally) -> Result<String> {
    let mut heard = Instant::now();
    let mut seen = vec![false; jobs.len()];
    while heard.elapsed() < PATIENCE {
        let Some(mut request) = server.recv_timeout(Duration::from_millis(200)).map_err(told)? else {
            if let Some(status) = child.try_wait().map_err(told)? {
                return Err(format!("the client ended with {status}"));
            }
            continue;
        };
        heard = Instant::now();
        if *request.method() == Method::Get {
            answer(request, jobs)?;
            continue;
        }
        let mut body = Vec::new();
        request.as_reader().read_to_end(&mut body).map_err(told)?;
        let path = request.url().to_owned();
        request.respond(Response::empty(204)).map_err(told)?;
        let words = || String::from_utf8_lossy(&body).into_owned();
        let (kind, number) = path[1..].split_once('/').unwrap_or((&path[1..], ""));
        let at = number.parse::<usize>().ok().filter(|number| *number < jobs.len());
        match (kind, at) {
            ("result", Some(at)) => {
                seen[at] = true;
                tally.add(jobs[at].case, Ok(bytemuck::pod_collect_to_vec(&body)))?;
            }
            ("fault", Some(at)) => {
                seen[at] = true;
                tally.add(jobs[at].case, Err(words()))?;
            }
            ("done", _) if seen.iter().all(|seen| *seen) => return Ok(words()),
            _ => return Err(format!("the client says {path}: {}", words())),
        }
    }
    Err(format!("the client said nothing for {} seconds", PATIENCE.as_secs()))
}

fn answer(request: Request, jobs: &[Job<'_>]) -> Result<()> {
    let url = request.url().split('?').next().unwrap_or_default().to_owned();
    let input = || jobs.get(url.strip_prefix("/input/")?.parse::<usize>().ok()?);
    let (body, kind) = if let Some((_, text, kind)) = FILES.iter().find(|(path, ..)| *path == url) {
        (text.as_bytes().to_vec(), *kind)
    } else if url == "/jobs" {
        let jobs = jobs.iter().map(|job| {
            let (read, written) = job.case.words();
            Told { text: &job.text, count: COUNT, read, written }
        });
        (serde_json::to_vec(&jobs.collect::<Vec<_>>()).map_err(told)?, "application/json")
    } else if let Some(job) = input() {
        (bytemuck::cast_slice(&job.case.input).to_vec(), "application/octet-stream")
    } else {
        return request.respond(Response::empty(404)).map_err(told);
    };
    let header = Header::from_bytes("Content-Type", kind).map_err(|()| "a bad header".to_owned())?;
    request.respond(Response::from_data(body).with_header(header)).map_err(told)
}
