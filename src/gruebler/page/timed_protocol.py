"""HTTP whose requests must be whole after some seconds: half requests would hold a connection each for ever."""

from __future__ import annotations

import asyncio

import h11
from uvicorn.protocols.http.h11_impl import H11Protocol

SECONDS = 10.0
"""From the first moment of a connection, or the first byte of a further request, to the last byte of the request."""


class TimedProtocol(H11Protocol):
    """Uvicorn's protocol with this limit; a WebSocket leaves it as soon as it is asked for."""

    _end: asyncio.TimerHandle | None = None

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """A request must follow."""
        super().connection_made(transport)
        self._end = self.loop.call_later(SECONDS, self.transport.abort)

    def data_received(self, data: bytes) -> None:
        """A request that is not whole yet has what is left of its time."""
        super().data_received(data)
        is_socket = self.transport.get_protocol() is not self
        if is_socket or self.conn.their_state not in (h11.IDLE, h11.SEND_BODY):
            self._forget()
        elif self._end is None:
            self._end = self.loop.call_later(SECONDS, self.transport.abort)

    def connection_lost(self, exc: Exception | None) -> None:
        """Nothing is awaited any more."""
        self._forget()
        super().connection_lost(exc)

    def _forget(self) -> None:
        if self._end is not None:
            self._end.cancel()
            self._end = None
