import type { IceCandidate } from '@farpoint/protocol';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { CandidateGate, takeCandidates } from './candidate-gate.ts';

let port = 1000;
const candidate = (
  usernameFragment?: string,
  more: Partial<Record<'transport' | 'address', string>> = {},
) => {
  const { transport = 'udp', address = '192.0.2.1' } = more;
  return {
    candidate: `candidate:1 1 ${transport} 2122252543 ${address} ${port++} typ host`,
    ...(usernameFragment === undefined ? {} : { usernameFragment }),
  } satisfies IceCandidate;
};

describe('CandidateGate', () => {
  it('keeps candidates until the description is set, then returns them in order of arrival', () => {
    const gate = new CandidateGate();
    const early = [candidate('a'), candidate(), candidate('a')];
    expect(early.map((one) => gate.take(one))).toEqual(['wait', 'wait', 'wait']);
    expect(gate.open(['a'])).toEqual(early);
    expect(early.map((one) => gate.take(one))).toEqual(['add', 'add', 'add']);
    expect(gate.take(candidate('a'))).toBe('add');
    expect(gate.waiting).toBe(0);
  });

  it('adds each address and port once, and few ports of one address, anew for each description', () => {
    const gate = new CandidateGate({ sameAddress: 2 });
    gate.open(['a']);
    const first = candidate('a');
    const again = { ...first, candidate: first.candidate.replace('candidate:1', 'candidate:2') };
    expect([first, again, candidate('a'), candidate('a')].map((one) => gate.take(one))).toEqual([
      ...['add', 'repeated', 'add', 'too-many'],
    ]);
    expect(gate.take(candidate('a', { address: '192.0.2.2' }))).toBe('add');
    gate.open(['b']);
    expect(gate.take({ ...first, usernameFragment: 'b' })).toBe('add');
  });

  it('reports an end of candidates as such, whenever it arrives', () => {
    const gate = new CandidateGate();
    expect(gate.take({ candidate: '' })).toBe('end');
    expect(gate.open(['a'])).toEqual([]);
    expect(gate.take({ candidate: '' })).toBe('end');
    expect(gate.take(candidate('a'))).toBe('add');
  });

  it('candidates of the next generation wait for its description; those of the last are left out', () => {
    const gate = new CandidateGate();
    gate.open(['first']);
    const next = candidate('second');
    expect(gate.take(next)).toBe('wait');
    expect(gate.take(candidate('first'))).toBe('add');
    gate.hold();
    // The fragment may recur, for example if a description changes without an ICE restart.
    const unsure = candidate('first');
    expect(gate.take(unsure)).toBe('wait');
    const unnamed = candidate();
    expect(gate.take(unnamed)).toBe('wait');
    expect(gate.open(['second'])).toEqual([next, unsure, unnamed]);
    expect([next, unsure, unnamed].map((one) => gate.take(one))).toEqual(['add', 'old-generation', 'add']);
    gate.hold();
    gate.open(['first']);
    expect(gate.take(unsure)).toBe('add');
    expect(gate.take(next)).toBe('old-generation');
  });

  it('reads the fragment from the candidate itself if it is given nowhere else', () => {
    const gate = new CandidateGate();
    gate.open(['a']);
    gate.hold();
    gate.open(['b']);
    const text = candidate().candidate;
    expect(gate.take({ candidate: `${text} generation 0 ufrag a network-cost 999` })).toBe('old-generation');
    expect(gate.take({ candidate: `${text} ufrag b` })).toBe('add');
  });

  it('leaves out invalid candidates and those that are not UDP, with or without a description', () => {
    const gate = new CandidateGate();
    for (let round = 0; round < 2; round++) {
      const injected = `${candidate().candidate}\r\na=ice-ufrag:x`;
      const portless = 'candidate:1 1 udp 1 192.0.2.1 typ host';
      for (const text of ['x', 'candidate:', portless, 'x'.repeat(999), injected])
        expect(gate.take({ candidate: text })).toBe('malformed');
      expect(gate.take(candidate('a', { transport: 'TCP' }))).toBe('not-udp');
      gate.open(['a']);
    }
    expect(gate.waiting).toBe(0);
  });

  it('limits how many candidates wait, are added and are looked up', () => {
    const gate = new CandidateGate({ waiting: 3, added: 4, names: 2 });
    const early = [1, 2, 3, 4].map(() => candidate());
    expect(early.map((one) => gate.take(one))).toEqual(['wait', 'wait', 'wait', 'queue-full']);
    expect(gate.open([])).toEqual(early.slice(1));
    const name = () => candidate(undefined, { address: '3f2a.local' });
    expect([name(), name(), name()].map((one) => gate.take(one))).toEqual(['add', 'add', 'too-many']);
    expect([1, 2, 3].map(() => gate.take(candidate()))).toEqual(['add', 'add', 'too-many']);
    // The next description has room again.
    gate.open([]);
    expect(gate.take(name())).toBe('add');
  });

  it('remembers a limited number of former generations', () => {
    const gate = new CandidateGate();
    for (let generation = 0; generation < 100; generation++) gate.open([`g${generation}`]);
    expect(gate.take(candidate('g98'))).toBe('old-generation');
    expect(gate.take(candidate('g1'))).toBe('wait');
  });
});

describe('takeCandidates', () => {
  it('removes candidates and their end, and leaves the rest unchanged', () => {
    const line = 'candidate:1 1 UDP 2122252543 192.0.2.1 5000 typ host';
    const sdp = `v=0\r\nm=audio 9 x\r\na=ice-ufrag:ab\r\na=${line}\r\na=mid:0\r\nm=video 9 x\r\na=end-of-candidates\r\na=${line}\r\na=ice-ufrag:cd\r\n`;
    expect(takeCandidates(sdp)).toEqual({
      sdp: 'v=0\r\nm=audio 9 x\r\na=ice-ufrag:ab\r\na=mid:0\r\nm=video 9 x\r\na=ice-ufrag:cd\r\n',
      candidates: [
        { candidate: line, sdpMLineIndex: 0 },
        { candidate: line, sdpMLineIndex: 1 },
      ],
      fragments: new Set(['ab', 'cd']),
    });
  });

  it('accepts any text', () => {
    const piece = fc.constantFrom(
      'm=audio\r\n',
      'a=candidate:x\n',
      'a=end-of-candidates',
      'a=ice-ufrag:u\r\n',
      '\r',
      'v',
    );
    fc.assert(
      fc.property(fc.array(fc.oneof(piece, fc.string({ maxLength: 5 }))), (pieces) => {
        const text = pieces.join('');
        const { sdp, candidates } = takeCandidates(text);
        expect(sdp.length).toBeLessThanOrEqual(text.length);
        if (!text.includes('candidate')) expect(sdp).toBe(text);
        for (const { candidate: line } of candidates) expect(text).toContain(`a=${line}`);
        expect(takeCandidates(sdp).candidates).toEqual([]);
      }),
    );
  });
});
