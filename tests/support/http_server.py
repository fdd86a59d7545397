#!/usr/bin/env python3
"""Serves a folder on a free port, which it prints first, and shows the faults that servers have:

/plain/FILE   the whole file whatever part is asked for
/range/FILE   parts as asked for (RFC 9110, Range: bytes=N-)
/cut/FILE     as range, but the connection ends after half of what was announced
"""
import functools
import http.server
import os
import sys


class Handler(http.server.SimpleHTTPRequestHandler):
    def do_GET(self):
        kind, _, name = self.path.lstrip("/").partition("/")
        path = os.path.join(self.directory, name)
        if not os.path.isfile(path):
            self.send_error(404)
            return
        with open(path, "rb") as file:
            content = file.read()
        self.send_part(content, 0 if kind == "plain" else self.first_byte(), kind == "cut")

    def first_byte(self):
        wanted = self.headers.get("Range", "bytes=0-")
        return int(wanted.removeprefix("bytes=").removesuffix("-"))

    def send_part(self, content, first, cut):
        if first >= len(content):
            self.send_error(416)
            return
        self.log_requests_to_file(first)
        part = content[first:]
        self.send_response(206 if first else 200)
        if first:
            self.send_header("Content-Range",
                             f"bytes {first}-{len(content) - 1}/{len(content)}")
        self.send_header("Content-Length", str(len(part)))
        self.end_headers()
        self.wfile.write(part[:len(part) // 2] if cut else part)

    def log_requests_to_file(self, first):
        with open(os.path.join(self.directory, "requests"), "a") as file:
            file.write(f"{self.path} from {first}\n")

    def log_message(self, *arguments):
        pass


server = http.server.HTTPServer(("127.0.0.1", 0),
                                functools.partial(Handler, directory=sys.argv[1]))
print(server.server_port, flush=True)
server.serve_forever()
