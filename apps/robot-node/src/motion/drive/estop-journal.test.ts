import { readdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { testFolder } from '@farpoint/service/testing/folder';
import fc from 'fast-check';
import { beforeEach, describe, expect, it } from 'vitest';
import { EstopJournal } from './estop-journal.ts';

let folder: string;
const faults: Error[] = [];
beforeEach(() => {
  folder = testFolder();
  faults.length = 0;
});

const open = (id = 'robot-1', at = folder) => new EstopJournal(at, id, (error) => faults.push(error));

describe('EstopJournal', () => {
  it('starts unlatched on the first run and after a clean end', () => {
    const first = open();
    expect(first.start.latched).toBeNull();
    first.end();
    expect(open().start.latched).toBeNull();
  });

  it('latches after a run that did not end cleanly', () => {
    open();
    expect(open().start.latched).toMatchObject({ by: 'robot', reason: 'unclean-exit' });
    // Nobody has released it, so it stays latched over any number of crashes or clean ends.
    open().end();
    expect(open().start.latched).toMatchObject({ by: 'robot', reason: 'was-latched' });
  });

  it('keeps a latched stop over a clean end, and forgets a released one', () => {
    const first = open();
    first.changed('operator');
    first.end();
    first.changed(null);
    const second = open();
    expect(second.start.latched).toMatchObject({ by: 'operator', reason: 'was-latched' });
    second.changed(null);
    second.end();
    expect(open().start.latched).toBeNull();
  });

  it('keeps the stops at the robot that hold it, apart from other latches', () => {
    const first = open();
    first.changed(null, ['key', 'gpio']);
    first.end();
    expect(open().start).toEqual({ latched: null, heldBy: ['key', 'gpio'] });
    const third = open();
    expect(third.start).toMatchObject({ latched: { reason: 'unclean-exit' }, heldBy: ['key', 'gpio'] });
    third.changed('operator', []);
    third.end();
    expect(open().start).toMatchObject({ latched: { by: 'operator' }, heldBy: [] });
  });

  it('reads what robots wrote that had no such stops', () => {
    writeFileSync(join(folder, 'robot-1.run.json'), '{"version":1,"running":false,"latchedBy":null}');
    expect(open().start).toEqual({ latched: null, heldBy: [] });
  });

  it('latches if the file cannot be read, whatever it contains', () => {
    fc.assert(
      fc.property(fc.oneof(fc.string(), fc.json()), (text) => {
        writeFileSync(join(folder, 'robot-1.run.json'), text);
        expect(open().start.latched).toMatchObject({ by: 'robot', reason: 'unreadable' });
      }),
      { seed: 8, numRuns: 100 },
    );
  });

  it('latches if it cannot write, and reports later faults', () => {
    const file = join(folder, 'no-folder');
    writeFileSync(file, '');
    const journal = open('robot-1', join(file, 'below'));
    expect(journal.start.latched).toMatchObject({ by: 'robot' });
    journal.changed(null);
    expect(faults).toHaveLength(1);
  });

  it('keeps one file per robot, and leaves no others', () => {
    open('a').end();
    open('b');
    expect(open('a').start.latched).toBeNull();
    expect(readdirSync(folder).sort()).toEqual(['a.run.json', 'b.run.json']);
  });
});
