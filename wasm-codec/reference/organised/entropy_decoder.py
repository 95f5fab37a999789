"""Sections "Packet" (words and raw bits) and "Entropy coder" (states, symbols, numbers)."""
from __future__ import annotations

from bisect import bisect_right

from .errors import BadPacket
from .tables import TOTAL, Context

STATES = 4  # A, B, C, D
FREE_BITS = 15  # of each state, when all is decoded


class EntropyDecoder:
    def __init__(self, data: bytes, words_start: int) -> None:
        self._data = data
        self._next_word = words_start
        self._raw_bits_read = 0
        self._turn = 0
        self._states = []
        for _ in range(STATES):
            n = self.bits(4) + FREE_BITS
            self._states.append(1 << n | self.bits(n))

    # Raw bits: from the packet's last byte backwards, from the lowest bit.

    def _raw_start(self) -> int:
        """Where the last byte lies of which a raw bit was read; the packet's end where none was."""
        return len(self._data) - (self._raw_bits_read + 7) // 8

    def bits(self, count: int) -> int:
        value = 0
        for i in range(count):
            byte, bit = divmod(self._raw_bits_read, 8)
            place = len(self._data) - 1 - byte
            if place < self._next_word:
                raise BadPacket('raw bits run out')
            value |= (self._data[place] >> bit & 1) << i
            self._raw_bits_read += 1
        return value

    def octaves(self) -> int:
        n = self.bits(4)
        return 1 << n | self.bits(n)

    # Symbols and numbers.

    def symbol_by(self, state: int, context: Context) -> int:
        """A symbol by the state with this number, 0 for A."""
        x = self._states[state]
        slot = x % TOTAL
        symbol = bisect_right(context.starts, slot) - 1
        x = context.frequencies[symbol] * (x // TOTAL) + slot - context.starts[symbol]
        if x < 1 << 15:
            if self._next_word + 2 > self._raw_start():
                raise BadPacket('words run out')
            x = x << 16 | self._data[self._next_word] | self._data[self._next_word + 1] << 8
            self._next_word += 2
        self._states[state] = x
        return symbol

    def start_turns(self) -> None:
        """A is first at the beginning of a tile and after a plane."""
        self._turn = 0

    def symbol(self, context: Context) -> int:
        """A symbol outside of planes, where A and B take turns."""
        symbol = self.symbol_by(self._turn, context)
        self._turn ^= 1
        return symbol

    def rest_of_number(self, symbol: int) -> int:
        """The number that begins with a symbol which has been decoded."""
        if symbol < 13:
            return symbol
        if symbol == 13:
            return 13 + self.bits(3)
        if symbol == 14:
            return 21 + self.bits(6)
        return 84 + self.octaves()

    def number(self, context: Context) -> int:
        return self.rest_of_number(self.symbol(context))

    # The end of a packet.

    def finish(self) -> int:
        """Checks that all has been read, and returns the 60 bits that the states hold in the end."""
        if self._next_word != self._raw_start():
            raise BadPacket('words or raw bits are left')
        used_bits = self._raw_bits_read % 8
        if used_bits and self._data[self._next_word] >> used_bits:
            raise BadPacket('the rest of the last raw byte is not 0')
        held = 0
        for i, x in enumerate(self._states):
            if x >> FREE_BITS != 1:
                raise BadPacket('a state does not end as it began')
            held |= (x ^ 1 << FREE_BITS) << FREE_BITS * i
        return held
