"""The server of the page: who may talk to it, what it refuses, in which order it answers."""

import asyncio
import json
import os
import re
import signal
import socket
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from pathlib import Path
from urllib.error import HTTPError
from urllib.request import Request, urlopen

import pytest

websockets = pytest.importorskip("websockets.sync.client", reason="the server of the page needs websockets")

from websockets.exceptions import InvalidStatus  # noqa: E402

from gruebler.files import linkage_to_json  # noqa: E402
from gruebler.mechanics.fourbar import FourBar  # noqa: E402
from gruebler.page import worker  # noqa: E402
from gruebler.page import workers as processes_of_the_page  # noqa: E402
from gruebler.page.model import model_of  # noqa: E402
from gruebler.page.requests import answer  # noqa: E402
from gruebler.teaching.catalog import entry  # noqa: E402
from tests.page.conftest import Server  # noqa: E402


def connected(server, **settings):
    origin = f"http://127.0.0.1:{server.port}"
    settings = {"origin": origin, "max_size": 2**26} | settings
    return websockets.connect(server.address.replace("http", "ws") + "ws", **settings)


def asked(socket, text: str) -> dict:
    socket.send(text)
    return json.loads(socket.recv(timeout=60))


def status(address: str, **headers: str) -> int:
    try:
        with urlopen(Request(address, headers=headers), timeout=10) as answer:
            return answer.status
    except HTTPError as error:
        return error.code


def test_who_does_not_know_the_token_or_the_name_gets_nothing(server):
    base = f"http://127.0.0.1:{server.port}"
    assert status(server.address) == 200
    assert status(server.address + "explorer.js") == 200
    for path in ("/", "/explorer.js", "/wrong/", "/wrong/explorer.js", "/../../etc/passwd", "/wrong/ws"):
        assert status(base + path) == 404
    assert status(server.address, Host="evil.example") == 404
    assert status(server.address, Host=f"evil.example:{server.port}") == 404
    assert status(server.address + "..%2fserver.py") == 404
    for host in ("localhost:evil.com", "127.0.0.1:80:80", "[::1]evil.com", "localhost:", "127.0.0.1.evil.com", ""):
        assert status(server.address, Host=host) in (400, 404), host
    for host in ("localhost", f"localhost:{server.port}", "127.0.0.1", "[::1]:80"):
        assert status(server.address, Host=host) == 200, host


@pytest.mark.parametrize("method", ["POST", "OPTIONS", "PUT", "DELETE"])
def test_other_methods_get_what_a_wrong_token_gets(server, method):
    base = f"http://127.0.0.1:{server.port}"
    for address in (server.address, base + "/wrong/", server.address + "explorer.js", base + "/wrong/explorer.js"):
        with pytest.raises(HTTPError) as refused:
            urlopen(Request(address, method=method), timeout=10)
        refused.value.close()
        assert refused.value.code == 404


@pytest.fixture
def impatient_server(monkeypatch):
    """A server in this process that waits a fifth of a second for a whole request; its port."""
    import uvicorn

    from gruebler.page import timed_protocol

    async def hello(scope, receive, send):
        await send({"type": "http.response.start", "status": 200, "headers": [(b"content-length", b"2")]})
        await send({"type": "http.response.body", "body": b"hi"})

    monkeypatch.setattr(timed_protocol, "SECONDS", 0.2)
    config = uvicorn.Config(hello, http=timed_protocol.TimedProtocol, lifespan="off", log_level="critical")
    server = uvicorn.Server(config)
    listening = socket.create_server(("127.0.0.1", 0))
    thread = threading.Thread(target=server.run, kwargs={"sockets": [listening]})
    thread.start()
    yield listening.getsockname()[1]
    server.should_exit = True
    thread.join()


HALVES = {
    "nothing": b"",
    "half a header": b"GET / HTTP/1.1\r\nHost: x\r\nX-Slow: ",
    "half a body": b"POST / HTTP/1.1\r\nHost: x\r\nContent-Length: 9\r\n\r\n1",
    "a request and a half": b"GET / HTTP/1.1\r\nHost: x\r\n\r\nGET / HT",
}


@pytest.mark.parametrize("half", HALVES)
def test_half_requests_are_ended(impatient_server, half):
    with socket.create_connection(("127.0.0.1", impatient_server), timeout=60) as client:
        client.sendall(HALVES[half])
        received = b""
        with suppress(ConnectionResetError):
            while piece := client.recv(4096):  # until the server closes
                received += piece
    assert received.count(b"hi") == half.count("body") + half.count("and")


def test_whole_requests_have_all_their_time(impatient_server):
    with socket.create_connection(("127.0.0.1", impatient_server), timeout=60) as client:
        for _ in range(2):
            client.sendall(b"GET / HTTP/1.1\r\nHost: x\r\n\r\n")
            received = b""
            while not received.endswith(b"hi"):
                received += client.recv(4096)
            assert received.count(b"hi") == 1
            time.sleep(0.5)  # longer than a request may take to arrive


@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="the system does not list processes")
def test_a_worker_killed_while_idle_is_replaced_before_the_next_request(server):
    with connected(server) as client:
        for _ in range(2):
            assert asked(client, '{"id": 7, "method": "exercise_kinds"}')["id"] == 7
            for pid in workers(server):
                os.kill(pid, signal.SIGKILL)
            answer = asked(client, '{"id": 8, "method": "exercise_kinds"}')
            assert "result" in answer, answer
    with urlopen(server.address, timeout=10) as answer:
        policy = answer.headers["Content-Security-Policy"]
        text = answer.read().decode()
    assert "default-src 'none'" in policy
    assert "unsafe" not in policy.replace("'wasm-unsafe-eval'", "")  # the kernels, docs/theory/explorer.md
    assert 'src="explorer.js"' in text


def test_what_views_ask_first_finds_its_modules_loaded():
    """By a worker that is begun before anybody asks; another process, since this one has loaded them."""
    program = """
import sys
from gruebler.page.requests import answer
from gruebler.page.worker import load
load()
before = set(sys.modules)
answer("catalog", {"words": "cam"}, "de", print)
for machine in ("belt", "cam", "delta", "sarrus"):
    answer("picture", {"id": machine}, "de", print)
answer("structure", {"text": "R(0-1) R(1-2) R(2-3) R(3-0) R(1-4) R(4-5) R(5-2)"}, "de", print)
print(sorted(set(sys.modules) - before))
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60, check=True)
    assert done.stdout == "[]\n"


def test_pictures_with_which_the_catalog_begins_are_drawn_before_anybody_asks():
    program = """
from gruebler.page.requests import answer
from gruebler.page.worker import load
from gruebler.teaching.catalog import machine_pictures
load()
machine_pictures.draw_machine = None  # nothing can be drawn any more
for lang in ("en", "de"):
    found = sorted(answer("catalog", {}, lang, print), key=lambda each: each["name"].casefold())
    assert all(answer("picture", {"id": each["id"]}, lang, print)["picture"] for each in found[:21])
"""
    subprocess.run([sys.executable, "-c", program], capture_output=True, timeout=60, check=True)


def test_a_search_and_the_pictures_before_it_are_answered_by_one_process(tmp_path):
    """A second one would load for seconds what the first one has."""
    server = Server(tmp_path)
    try:
        with connected(server) as client:
            for number, id in enumerate(("delta", "gough", "sarrus", "schatz", "bennett", "jansen")):
                client.send(json.dumps({"id": number, "method": "picture", "params": {"id": id}}))
            client.send('{"id": 6, "method": "catalog", "params": {"words": "cam"}}')
            order = [json.loads(client.recv(timeout=60))["id"] for _ in range(7)]
        assert sorted(order) == [*range(7)]
        assert order[-1] != 6  # the search does not wait for all pictures
        assert len(workers(server)) == 1
    finally:
        server.kill()


def test_what_is_loaded_before_anybody_asks_meets_no_request(monkeypatch):
    """Two threads that import a package at once found it half made: a busy machine's catalog stayed empty."""
    running, most = 0, 0

    def answer(*_):
        nonlocal running, most
        running += 1
        most = max(most, running)
        time.sleep(0.02)
        running -= 1

    monkeypatch.setattr(worker, "answer", answer)
    loader = threading.Thread(target=worker.load)
    loader.start()
    for _ in range(10):
        worker.answered("catalog", {}, "en", print)
    loader.join()
    assert most == 1


def test_a_socket_from_another_origin_is_closed(server):
    for origin in (None, "http://evil.example", f"http://127.0.0.1:{server.port + 1}"):
        with pytest.raises(InvalidStatus), connected(server, origin=origin) as socket:
            socket.recv(timeout=5)


@pytest.mark.parametrize(
    ("frame", "words"),
    [
        ("{", "not a message"),
        ('{"id": 1, "method": "measures", "params": {"document": {"a": NaN}}}', "not a message"),
        ('{"id": 1, "method": "measures", "params": {"document": ' + "[" * 9000 + "]" * 9000 + "}}", ""),
        ('{"id": 1, "method": "measures", "params": {"document": ' + '{"a":' * 9000 + "1" + "}" * 9000 + "}}", ""),
        ('{"id": "one", "method": "catalog"}', "id"),
        ('{"id": 1, "method": "catalog", "surplus": 1}', "surplus"),
        ('{"id": 1, "method": "shutdown"}', "There is no request 'shutdown'"),
        ('{"id": 1, "method": "__class__", "params": {}}', "There is no request"),
        ('{"id": 1, "method": "chains", "params": {"links": 40}}', "links"),
        ('{"id": 1, "method": "chains", "params": {"links": 1e400}}', ""),
        ('{"id": 1, "method": "open", "params": {"id": "../../etc/passwd"}}', "passwd"),
        ('{"id": 1, "method": "open", "params": {}}', "id"),
        ('{"id": 1, "method": "structure", "params": {"text": "' + "R(0-1)" * 5000 + '"}}', "length"),
        ('{"id": 1, "method": "measures", "params": {"document": {"joints": "R(0-1)"}}}', ""),
        ('"' + "x" * 500_000 + '"', "at most 400,000 characters"),
    ],
)
def test_hostile_frames_get_one_sentence_and_the_next_question_its_answer(server, frame, words):
    with connected(server) as socket:
        answer = asked(socket, frame)
        assert "\n" not in answer["error"]
        assert 0 < len(answer["error"]) < 1200
        assert words in answer["error"]
        assert asked(socket, '{"id": 7, "method": "exercise_kinds"}')["id"] == 7


def test_bytes_are_refused(server):
    with connected(server) as socket:
        socket.send(b"\x00\xff")
        assert "not bytes" in json.loads(socket.recv(timeout=20))["error"]


def test_two_pages_and_a_hundred_drags_each(server):
    """No answer is lost, none comes out of order, each is that of its own question."""
    failures: list[str] = []

    def page(first: float) -> None:
        lengths = [first + 0.1 * k for k in range(100)]
        with connected(server) as socket:
            for k, length in enumerate(lengths):
                document = linkage_to_json(FourBar(length, 70, 40, 70).linkage())
                text = {"id": k, "method": "open_document", "params": {"document": document}, "lang": "de"}
                socket.send(json.dumps(text))
            for k, length in enumerate(lengths):
                answer = json.loads(socket.recv(timeout=120))
                crank = answer["result"]["document"]["elements"]["crank"]["R(crank-coupler)"][0]
                if answer["id"] != k or crank != pytest.approx(length):
                    failures.append(f"{answer['id']} instead of {k}")

    threads = [threading.Thread(target=page, args=(first,)) for first in (18.0, 24.0)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert failures == []
    if Path(f"/proc/{server.process.pid}").is_dir():
        assert len(workers(server)) <= 2


def memory(server) -> float:
    """Megabytes that the server and its workers hold."""
    status = [Path(f"/proc/{pid}/status").read_text() for pid in (server.process.pid, *workers(server))]
    return sum(int(re.search(r"VmRSS:\s*(\d+)", text)[1]) for text in status) / 1024


@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="the system does not say how much memory was used")
def test_memory_does_not_grow_with_what_was_asked(server):
    """Twice as many drags again take no more than what rounding of heaps does; the whole stays below a bound."""

    def drags(count: int) -> None:
        with connected(server) as socket:
            for k in range(count):
                document = linkage_to_json(FourBar(20 + 0.05 * (k % 100), 70, 40, 70).linkage({"K": (45, 40)}))
                method = ("open_document", "measures")[k % 2]
                socket.send(json.dumps({"id": k, "method": method, "params": {"document": document}}))
                assert json.loads(socket.recv(timeout=120))["id"] == k

    drags(40)
    first = memory(server)
    drags(80)
    assert memory(server) < first + 40
    assert memory(server) < 1500


def workers(server) -> list[int]:
    """The processes that the server has started."""
    children = Path(f"/proc/{server.process.pid}/task/{server.process.pid}/children")
    return [int(pid) for pid in children.read_text().split()]


LONG = json.dumps({"id": 1, "method": "chains", "params": {"links": 12, "start": 6000}})


def answers_to(socket, *frames: str, count: int = 1) -> list[dict]:
    """The first answers after these frames, without what tells how far work is."""
    for frame in frames:
        socket.send(frame)
    found: list[dict] = []
    while len(found) < count:
        answer = json.loads(socket.recv(timeout=60))
        if "progress" not in answer:
            found.append(answer)
    return found


def test_long_work_is_cancelled(server):
    with connected(server) as socket:
        waits = '{"id": 2, "method": "modes"}'
        first, second = answers_to(socket, LONG, waits, '{"id": 1, "cancel": true}', count=2)
        assert first == {"id": 1, "cancelled": True}
        assert second["id"] == 2


def test_a_search_does_not_wait_for_long_work_before_it(server):
    with connected(server) as socket:
        (answer,) = answers_to(socket, LONG, '{"id": 2, "method": "catalog", "params": {"words": "delta"}}')
        assert (answer["id"], [each["id"] for each in answer["result"]]) == (2, ["delta"])
        assert answers_to(socket, '{"id": 1, "cancel": true}') == [{"id": 1, "cancelled": True}]


def test_a_process_that_is_about_to_answer_is_kept(monkeypatch):
    """Whoever leaves, or loads the page again, leaves it for the next request, which need not wait for a new one."""
    monkeypatch.setattr(processes_of_the_page, "_NEARLY", 30.0)  # also where the machine is busy

    async def processes() -> list[int]:
        made, gone = processes_of_the_page.Workers(), asyncio.Event()
        try:
            asking = asyncio.create_task(made.ask("structure", {"text": "R(0-1) R(1-2)"}, "en", print, gone))
            while not made._all:
                await asyncio.sleep(0.01)
            seen = [process.pid for process in made._all]
            gone.set()
            with pytest.raises(processes_of_the_page.CancelledError):
                await asking
            return [*seen, *(process.pid for process in made._free)]
        finally:
            await made.close()

    with ThreadPoolExecutor() as beside:  # of the loop of the browser
        before, after = beside.submit(asyncio.run, processes()).result()
    assert before == after


def test_a_request_that_waits_is_cancelled_before_the_one_it_waits_for(server):
    with connected(server) as socket:
        waits = '{"id": 2, "method": "modes"}'
        assert answers_to(socket, LONG, waits, '{"id": 2, "cancel": true}') == [{"id": 2, "cancelled": True}]
        assert answers_to(socket, '{"id": 1, "cancel": true}') == [{"id": 1, "cancelled": True}]


def test_answers_are_those_of_the_library(server):
    linkage = FourBar(25, 70, 40, 70).linkage()
    with connected(server) as socket:
        question = {"id": 1, "method": "open_document", "params": {"document": linkage_to_json(linkage)}}
        found = asked(socket, json.dumps(question))["result"]
    wanted = json.loads(json.dumps(model_of(linkage)))
    assert found["program"] == wanted["program"]
    assert found["start"] == wanted["start"]


def test_words_name_links_as_the_page_does():
    """With spaces: the names of the file are those of the command line."""
    document = linkage_to_json(entry("bolt_cutter").linkage())
    said = answer("measures", {"document": document, "source": "bolt_cutter"}, "en", print)
    words = "\n".join(said["lines"])
    assert "The output upper jaw swings" in words
    assert "_" not in words
    document = linkage_to_json(entry("wiper").linkage().renamed({"blade": "coupler1"}))
    assert "output coupler 1 " in answer("measures", {"document": document}, "en", print)["lines"][1]
