import { officeWorld, SimulatedBase } from '@farpoint/sim';
import { expect, it } from 'vitest';
import { makeSharedSnapshot, SnapshotReader, SnapshotWriter } from './shared-snapshot.ts';

function shared() {
  const base = new SimulatedBase(officeWorld());
  const memory = makeSharedSnapshot(base.world.movers.length);
  return { base, memory, writer: new SnapshotWriter(memory), reader: new SnapshotReader(memory) };
}

it('is empty before the first snapshot, then returns the newest', () => {
  const { base, writer, reader } = shared();
  expect(reader.read()).toBeNull();
  writer.write(base.snapshot);
  expect(reader.read()).toEqual(base.snapshot);
  base.step(1);
  writer.write(base.snapshot);
  expect(reader.read()).toEqual(base.snapshot);
});

it('never returns a half-written snapshot', () => {
  const { base, memory, writer, reader } = shared();
  writer.write(base.snapshot);
  // As if the writer had died during a write.
  Atomics.add(new Int32Array(memory, 0, 1), 0, 1);
  expect(reader.read()).toBeNull();
});
