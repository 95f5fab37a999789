import fc from 'fast-check';
import { expect, it } from 'vitest';
import { makeSharedGrid, SharedGridReader, SharedGridWriter } from './shared-grid.ts';

const SHAPE = { side: 6, cellM: 0.05 };

function shared() {
  const memory = makeSharedGrid(SHAPE);
  return { writer: new SharedGridWriter(memory, SHAPE), reader: new SharedGridReader(memory, SHAPE) };
}
const grid = (n: number) => ({
  ...{ capturedAtMs: n, placed: n % 2 === 0, disputed: n % 3 === 0, firstX: -n, firstY: n },
  classes: new Uint8Array(36).fill(n),
});
const written = (n: number) => ({ ...grid(n), tookMs: n / 10 });

it('hands the newest grid on once', () => {
  const { writer, reader } = shared();
  expect(reader.read()).toBeNull();
  writer.write(written(1));
  writer.write(written(2));
  expect(reader.read()).toEqual({ ...SHAPE, ...grid(2) });
  expect(reader.read()).toBeNull();
  expect(reader.count).toEqual({ grids: 1, lastMs: 0.2 });
});

it('does not touch the grid that is being read, and loses none that is newer, in any order of calls', () => {
  fc.assert(
    fc.property(fc.array(fc.boolean(), { maxLength: 60 }), (writes) => {
      const { writer, reader } = shared();
      let [last, read] = [0, 0];
      let held: ReturnType<SharedGridReader['read']> = null;
      for (const write of writes) {
        if (write) writer.write(written(++last));
        else {
          const next = reader.read();
          expect(next === null).toBe(last === read);
          if (next !== null) [held, read] = [next, last];
        }
        if (held !== null) expect(held).toEqual({ ...SHAPE, ...grid(read) });
      }
    }),
    { seed: 4 },
  );
});
