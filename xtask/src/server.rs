//! A static web server for this machine: it serves like a plain host, with the strictest headers
//! the page must live with.

use std::io::ErrorKind;
use std::net::{Ipv4Addr, TcpListener};
use std::path::Path;
use std::thread::{self, JoinHandle};

use anyhow::{Context, Result, anyhow};
use http_body_util::{Either, Full};
use hyper::body::{Bytes, Incoming};
use hyper::header::{CONTENT_TYPE, HeaderMap, HeaderValue};
use hyper::server::conn::http1;
use hyper::service::service_fn;
use hyper::{Request, Response, StatusCode};
use hyper_util::rt::TokioIo;
use tower_http::services::ServeDir;
use tower_http::services::fs::ServeFileSystemResponseBody;
use tower_service::Service;

use crate::site::POLICY;

/// The port that `serve` tries first, and how many after it.
const PORTS: std::ops::Range<u16> = 8080..8180;

/// A response header: name and value.
type Line = (&'static str, &'static str);

/// Sent with every response of the site.
const STRICT: &[Line] = &[
    CACHE,
    ("x-content-type-options", "nosniff"),
    ("referrer-policy", "no-referrer"),
    ("content-security-policy", POLICY),
];

/// Headers of a documentation host: the pages of rustdoc and mdBook contain scripts.
const PLAIN: &[Line] = &[CACHE];

/// A browser keeps a file, with the code compiled from it, and asks each time whether it is still
/// valid.
const CACHE: Line = ("cache-control", "no-cache");

/// A running server; it lives as long as the process.
pub(crate) struct Server {
    /// Its address, with a slash at the end.
    pub(crate) url: String,
    thread: JoinHandle<Result<()>>,
}

/// Serves `site` until the process is stopped, and prints the address.
///
/// # Errors
/// If no port is free.
pub(crate) fn serve(site: &Path) -> Result<()> {
    let server = Server::start(site, first_free(PORTS)?, STRICT)?;
    println!("Armill is at {}  (Ctrl+C stops it)", server.url);
    server.thread.join().map_err(|_| anyhow!("the thread of the server panicked"))?
}

impl Server {
    /// Serves `site` on any free port.
    ///
    /// # Errors
    /// If listening is not permitted on this machine.
    pub(crate) fn start_anywhere(site: &Path) -> Result<Server> {
        Server::start(site, TcpListener::bind((Ipv4Addr::LOCALHOST, 0))?, STRICT)
    }

    /// Serves `docs` on any free port, without a policy of its own.
    ///
    /// # Errors
    /// If listening is not permitted on this machine.
    pub(crate) fn start_plain(docs: &Path) -> Result<Server> {
        Server::start(docs, TcpListener::bind((Ipv4Addr::LOCALHOST, 0))?, PLAIN)
    }

    fn start(site: &Path, listener: TcpListener, headers: &'static [Line]) -> Result<Server> {
        let url = format!("http://{}/", listener.local_addr()?);
        let files = ServeDir::new(site);
        let runtime = tokio::runtime::Builder::new_current_thread().enable_io().build()?;
        let thread = thread::Builder::new().spawn(move || runtime.block_on(run(listener, files, headers)))?;
        Ok(Server { url, thread })
    }
}

/// Listens on the first free port.
fn first_free(ports: std::ops::Range<u16>) -> Result<TcpListener> {
    for port in ports.clone() {
        match TcpListener::bind((Ipv4Addr::LOCALHOST, port)) {
            Err(error) if error.kind() == ErrorKind::AddrInUse => (),
            result => return result.with_context(|| format!("cannot listen on port {port}")),
        }
    }
    Err(anyhow!("the ports {} to {} are all taken", ports.start, ports.end - 1))
}

/// Answers all connections, each in its own task.
async fn run(listener: TcpListener, files: ServeDir, headers: &'static [Line]) -> Result<()> {
    listener.set_nonblocking(true)?;
    let listener = tokio::net::TcpListener::from_std(listener)?;
    loop {
        // The browser may have closed the connection, now or while it is answered.
        let Ok((stream, _)) = listener.accept().await else { continue };
        let files = files.clone();
        let service = service_fn(move |request| answer(request, files.clone(), headers));
        tokio::spawn(http1::Builder::new().serve_connection(TokioIo::new(stream), service));
    }
}

type Reply = Response<Either<Full<Bytes>, ServeFileSystemResponseBody>>;

/// A file, or the reason why there is none, with the headers.
async fn answer(request: Request<Incoming>, mut files: ServeDir, headers: &[Line]) -> Result<Reply> {
    // For a folder, `ServeDir` would redirect `//name` to `//name/`, which is another host.
    let astray = request.uri().path().contains("//");
    let found = files.call(request).await?;
    let mut reply = if astray || found.status() == StatusCode::NOT_FOUND {
        let body = Either::Left(Full::from("Not found\n"));
        Response::builder().status(StatusCode::NOT_FOUND).header(CONTENT_TYPE, "text/plain").body(body)?
    } else {
        found.map(Either::Right)
    };
    name_charset(reply.headers_mut())?;
    for &(name, value) in headers {
        reply.headers_mut().insert(name, HeaderValue::from_static(value));
    }
    Ok(reply)
}

/// Adds the encoding of all texts, which `ServeDir` leaves open.
fn name_charset(headers: &mut HeaderMap) -> Result<()> {
    let media_type = headers.get(CONTENT_TYPE).and_then(|value| value.to_str().ok()).unwrap_or_default();
    if media_type.starts_with("text/") {
        let full = HeaderValue::from_str(&format!("{media_type}; charset=utf-8"))?;
        headers.insert(CONTENT_TYPE, full);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs::{self, File};
    use std::io::{Read, Write};
    use std::net::TcpStream;
    use std::time::{Duration, SystemTime};

    fn site() -> tempfile::TempDir {
        let parent = tempfile::tempdir().unwrap();
        let site = parent.path().join("site");
        fs::create_dir_all(site.join("pkg")).unwrap();
        fs::write(parent.path().join("secret.txt"), "secret").unwrap();
        fs::write(site.join("index.html"), "<p>page").unwrap();
        fs::write(site.join("a b.js"), "1").unwrap();
        fs::write(site.join("pkg/armill_bg.wasm"), vec![0; 100_000]).unwrap();
        parent
    }

    /// Head and body of the response to a raw request.
    fn ask(server: &Server, method: &str, path: &str) -> (String, Vec<u8>) {
        ask_with(server, method, path, "")
    }

    /// Head and body of the response to a request with more header lines.
    fn ask_with(server: &Server, method: &str, path: &str, lines: &str) -> (String, Vec<u8>) {
        let address = server.url.strip_prefix("http://").unwrap().strip_suffix('/').unwrap();
        let mut stream = TcpStream::connect(address).unwrap();
        write!(stream, "{method} {path} HTTP/1.1\r\nHost: {address}\r\n{lines}Connection: close\r\n\r\n")
            .unwrap();
        let mut answer = Vec::new();
        stream.read_to_end(&mut answer).unwrap();
        let end = answer.windows(4).position(|window| window == b"\r\n\r\n").unwrap();
        (String::from_utf8(answer[..end].to_vec()).unwrap(), answer[end + 4..].to_vec())
    }

    #[test]
    fn files_come_with_their_type_length_and_headers() {
        let parent = site();
        let server = Server::start_anywhere(&parent.path().join("site")).unwrap();
        let (head, body) = ask(&server, "GET", "/?x=/../y");
        assert!(head.starts_with("HTTP/1.1 200"), "{head}");
        assert!(head.contains("content-type: text/html; charset=utf-8"), "{head}");
        assert!(STRICT.iter().all(|(name, value)| head.contains(&format!("{name}: {value}"))), "{head}");
        assert_eq!(body, b"<p>page");

        let (head, body) = ask(&server, "GET", "/pkg/armill_bg.wasm");
        assert!(head.contains("content-type: application/wasm"), "{head}");
        assert_eq!(body, vec![0; 100_000]);
        let (head, body) = ask(&server, "HEAD", "/pkg/armill_bg.wasm");
        assert!(head.contains("content-length: 100000"), "{head}");
        assert!(body.is_empty(), "HEAD has no body");

        assert!(ask(&server, "GET", "/a%20b.js").0.contains("content-type: text/javascript"));
        assert!(ask(&server, "GET", "/pkg?q").0.contains("location: /pkg/?q"));
        assert!(ask(&server, "POST", "/").0.starts_with("HTTP/1.1 405"));
    }

    #[test]
    fn what_a_browser_has_is_not_sent_again_until_it_changes() {
        let parent = site();
        let server = Server::start_anywhere(&parent.path().join("site")).unwrap();
        let (head, _) = ask(&server, "GET", "/a%20b.js");
        let tag = head.lines().find_map(|line| line.strip_prefix("etag: ")).unwrap();
        let lines = format!("If-None-Match: {tag}\r\n");
        let (head, body) = ask_with(&server, "GET", "/a%20b.js", &lines);
        assert!(head.starts_with("HTTP/1.1 304") && body.is_empty(), "{head}");
        assert!(STRICT.iter().all(|(name, value)| head.contains(&format!("{name}: {value}"))), "{head}");
        let script = parent.path().join("site/a b.js");
        fs::write(&script, "2").unwrap();
        // The clock of a file system ticks every few milliseconds.
        let later = SystemTime::now() + Duration::from_secs(1);
        File::options().write(true).open(&script).unwrap().set_modified(later).unwrap();
        let (head, body) = ask_with(&server, "GET", "/a%20b.js", &lines);
        assert!(head.starts_with("HTTP/1.1 200") && body == b"2", "{head}");
    }

    #[test]
    fn nothing_outside_the_site_is_served() {
        let parent = site();
        let server = Server::start_anywhere(&parent.path().join("site")).unwrap();
        let outside = [
            "/../secret.txt",
            "/%2e%2e/secret.txt",
            "/pkg/../../secret.txt",
            "/..%2fsecret.txt",
            "/..%5csecret.txt",
            "//pkg",
            "/pkg/",
            "/index.html/",
            "/missing",
            "/%zz",
            "/%ff",
            "/%2",
        ];
        for path in outside {
            let (head, body) = ask(&server, "GET", path);
            assert!(head.starts_with("HTTP/1.1 404"), "{path}: {head}");
            assert_eq!(body, b"Not found\n", "{path}");
        }
    }

    #[test]
    fn a_taken_port_is_passed_over() {
        let taken = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).unwrap();
        let port = taken.local_addr().unwrap().port();
        if let Ok(listener) = first_free(port..port.saturating_add(20)) {
            assert_ne!(listener.local_addr().unwrap().port(), port);
        }
        let error = first_free(port..port + 1).unwrap_err();
        assert_eq!(error.to_string(), format!("the ports {port} to {port} are all taken"));
    }
}
