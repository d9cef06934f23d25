//! A static web server for this machine: it serves like a plain host, with the strictest headers
//! the page must live with.

use std::fs;
use std::io::{Cursor, ErrorKind};
use std::net::{Ipv4Addr, TcpListener};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::thread::{self, JoinHandle};

use anyhow::{Context, Result, anyhow};
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use sha2::{Digest, Sha256};
use tiny_http::{Header, Method, Request, Response};

use crate::site::POLICY;

/// The port that `serve` tries first, and how many after it.
const PORTS: std::ops::Range<u16> = 8080..8180;

/// Enough for a browser, which opens up to six connections.
const THREADS: usize = 6;

/// A response header: name and value.
type Line = (&'static str, &'static str);

/// Sent with every response of the site.
const STRICT: &[Line] = &[
    CACHE,
    ("X-Content-Type-Options", "nosniff"),
    ("Referrer-Policy", "no-referrer"),
    ("Content-Security-Policy", POLICY),
];

/// Headers of a documentation host: the pages of rustdoc and mdBook contain scripts.
const PLAIN: &[Line] = &[CACHE];

/// A browser keeps a file, with the code compiled from it, and asks each time whether it is still
/// valid.
const CACHE: Line = ("Cache-Control", "no-cache");

/// A running server; it lives as long as the process.
pub(crate) struct Server {
    /// Its address, with a slash at the end.
    pub(crate) url: String,
    threads: Vec<JoinHandle<()>>,
}

/// Serves `site` until the process is stopped, and prints the address.
///
/// # Errors
/// If no port is free.
pub(crate) fn serve(site: &Path) -> Result<()> {
    let server = Server::start(site, first_free(PORTS)?, STRICT)?;
    println!("Armill is at {}  (Ctrl+C stops it)", server.url);
    for thread in server.threads {
        thread.join().map_err(|_| anyhow!("a thread of the server panicked"))?;
    }
    Ok(())
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
        let listener = tiny_http::Server::from_listener(listener, None).map_err(|error| anyhow!(error))?;
        let (listener, site) = (Arc::new(listener), Arc::<Path>::from(site));
        let threads = (0..THREADS).map(|_| {
            let (listener, site) = (Arc::clone(&listener), Arc::clone(&site));
            thread::spawn(move || {
                for request in listener.incoming_requests() {
                    answer(&site, request, headers);
                }
            })
        });
        Ok(Server { url, threads: threads.collect() })
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

fn answer(site: &Path, request: Request, headers: &[Line]) {
    let mut response = match request.method() {
        Method::Get | Method::Head => match find(site, request.url()) {
            Found::File(path) => match fs::read(&path) {
                Ok(content) => fresh(&request, media_type(&path), content),
                Err(_) => not_found(),
            },
            Found::Folder(location) => with(reply(308, TEXT, Vec::new()), &format!("Location: {location}")),
            Found::Nothing => not_found(),
        },
        _ => with(reply(405, TEXT, b"Only GET and HEAD\n".to_vec()), "Allow: GET, HEAD"),
    };
    for (name, value) in headers {
        response = with(response, &format!("{name}: {value}"));
    }
    // The browser may have closed the connection.
    let _ = request.respond(response);
}

type Reply = Response<Cursor<Vec<u8>>>;

const TEXT: &str = "text/plain; charset=utf-8";

fn reply(status: u16, media_type: &str, content: Vec<u8>) -> Reply {
    // The length is known, so send it; tiny_http would send large files in chunks.
    let response = Response::from_data(content).with_status_code(status).with_chunked_threshold(usize::MAX);
    with(response, &format!("Content-Type: {media_type}"))
}

/// A file's content with its tag, or 304 if the browser's copy has this tag.
fn fresh(request: &Request, media_type: &str, content: Vec<u8>) -> Reply {
    let tag = format!("\"{}\"", BASE64_STANDARD.encode(Sha256::digest(&content)));
    let asked = request.headers().iter().find(|header| header.field.equiv("If-None-Match"));
    let holds = asked.is_some_and(|header| header.value.as_str() == tag);
    let response = if holds { reply(304, media_type, Vec::new()) } else { reply(200, media_type, content) };
    with(response, &format!("ETag: {tag}"))
}

fn not_found() -> Reply {
    reply(404, TEXT, b"Not found\n".to_vec())
}

fn with(mut response: Reply, header: &str) -> Reply {
    if let Ok(header) = header.parse::<Header>() {
        response.add_header(header);
    }
    response
}

/// The target of a request's path.
#[derive(Debug, PartialEq)]
enum Found {
    File(PathBuf),
    /// A folder requested without the slash at its end: the same address with it.
    Folder(String),
    Nothing,
}

fn find(site: &Path, url: &str) -> Found {
    let (path, query) = url.split_at(url.find(['?', '#']).unwrap_or(url.len()));
    let Some(names) = path.strip_prefix('/').and_then(names) else { return Found::Nothing };
    let target = names.iter().fold(site.to_path_buf(), |folder, name| folder.join(name));
    match (target.is_dir(), path.ends_with('/')) {
        (true, true) => Found::File(target.join("index.html")),
        (true, false) => Found::Folder(format!("{path}/{query}")),
        (false, false) if target.is_file() => Found::File(target),
        _ => Found::Nothing,
    }
}

/// The names in a path, decoded; nothing if one of them could lead out of the site.
fn names(path: &str) -> Option<Vec<String>> {
    let path = path.strip_suffix('/').unwrap_or(path);
    if path.is_empty() {
        return Some(Vec::new());
    }
    let names = path.split('/').map(decode).collect::<Option<Vec<_>>>()?;
    let harmless =
        |name: &String| !matches!(name.as_str(), "" | "." | "..") && !name.contains(['/', '\\', ':', '\0']);
    names.iter().all(harmless).then_some(names)
}

/// Replaces `%41` by `A` and so on; nothing if that is not UTF-8.
fn decode(name: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(name.len());
    let mut rest = name.as_bytes();
    while let Some((&first, tail)) = rest.split_first() {
        if first == b'%' {
            let digits = std::str::from_utf8(tail.get(..2)?).ok()?;
            bytes.push(u8::from_str_radix(digits, 16).ok()?);
            rest = &tail[2..];
        } else {
            bytes.push(first);
            rest = tail;
        }
    }
    String::from_utf8(bytes).ok()
}

/// The media type of a file, by its name.
fn media_type(path: &Path) -> &'static str {
    match path.extension().and_then(|extension| extension.to_str()).unwrap_or_default() {
        "html" => "text/html; charset=utf-8",
        "css" => "text/css; charset=utf-8",
        "js" | "mjs" => "text/javascript; charset=utf-8",
        "wasm" => "application/wasm",
        "json" => "application/json",
        "webmanifest" => "application/manifest+json",
        "csv" => "text/csv; charset=utf-8",
        "apt" | "md" | "nc" | "ts" | "txt" => TEXT,
        "svg" => "image/svg+xml",
        "png" => "image/png",
        "ico" => "image/x-icon",
        _ => "application/octet-stream",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::{Read, Write};
    use std::net::TcpStream;

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
        assert!(head.contains("Content-Type: text/html; charset=utf-8"), "{head}");
        assert!(STRICT.iter().all(|(name, value)| head.contains(&format!("{name}: {value}"))), "{head}");
        assert_eq!(body, b"<p>page");

        let (head, body) = ask(&server, "GET", "/pkg/armill_bg.wasm");
        assert!(head.contains("Content-Type: application/wasm"), "{head}");
        assert_eq!(body, vec![0; 100_000]);
        let (head, body) = ask(&server, "HEAD", "/pkg/armill_bg.wasm");
        assert!(head.contains("Content-Length: 100000"), "{head}");
        assert!(body.is_empty(), "HEAD has no body");

        assert!(ask(&server, "GET", "/a%20b.js").0.contains("Content-Type: text/javascript"));
        assert!(ask(&server, "GET", "/pkg?q").0.contains("Location: /pkg/?q"));
        assert!(ask(&server, "POST", "/").0.starts_with("HTTP/1.1 405"));
    }

    #[test]
    fn what_a_browser_has_is_not_sent_again_until_it_changes() {
        let parent = site();
        let server = Server::start_anywhere(&parent.path().join("site")).unwrap();
        let (head, _) = ask(&server, "GET", "/a%20b.js");
        let tag = head.lines().find_map(|line| line.strip_prefix("ETag: ")).unwrap();
        let lines = format!("If-None-Match: {tag}\r\n");
        let (head, body) = ask_with(&server, "GET", "/a%20b.js", &lines);
        assert!(head.starts_with("HTTP/1.1 304") && body.is_empty(), "{head}");
        assert!(STRICT.iter().all(|(name, value)| head.contains(&format!("{name}: {value}"))), "{head}");
        fs::write(parent.path().join("site/a b.js"), "2").unwrap();
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
