import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { PAGE_SURFELS, packPlace, voxelOf } from './memory-layout.ts';
import { SurfelStore } from './surfel-store.ts';

/** All surfels, as chunk:voxel. */
function contents(store: SurfelStore): Map<string, number> {
  const all = new Map<string, number>();
  for (let chunk = 0; chunk < store.pages; chunk++) {
    const at = `${store.chunkX[chunk]},${store.chunkY[chunk]},${store.chunkZ[chunk]}`;
    for (let page = store.chunkPages[chunk] as number; page >= 0; page = store.pageNext[page] as number) {
      expect(store.pageChunks[page]).toBe(chunk);
      for (let i = 0; i < (store.pageCounts[page] as number); i++) {
        const surfel = page * PAGE_SURFELS + i;
        all.set(`${at}:${voxelOf(store.places[surfel] as number)}`, store.colours[surfel] as number);
      }
    }
  }
  return all;
}

describe('SurfelStore', () => {
  test('holds what was added and not removed, in pages of its bound', () => {
    const action = fc.record({
      chunk: fc.integer({ min: -2, max: 2 }),
      voxel: fc.nat(700),
      kind: fc.constantFrom('add', 'add', 'add', 'remove', 'forget'),
    });
    fc.assert(
      fc.property(fc.array(action, { maxLength: 1500 }), (actions) => {
        const store = new SurfelStore(6);
        const expected = new Map<string, number>();
        for (const [i, { chunk: x, voxel, kind }] of actions.entries()) {
          const place = packPlace((voxel & 31) << 5, (voxel >> 5) << 5, 7);
          const key = `${x},0,${-x}:${voxelOf(place)}`;
          let chunk = store.findChunk(x, 0, -x);
          if (kind === 'forget') {
            // Rare, or nothing would ever be full.
            if (chunk < 0 || i % 50 !== 0) continue;
            store.removeChunk(chunk);
            for (const each of [...expected.keys()]) if (each.startsWith(`${x},0,`)) expected.delete(each);
            continue;
          }
          if (chunk < 0 && kind === 'add') chunk = store.addChunk(x, 0, -x);
          if (chunk < 0) continue;
          const there = store.find(chunk, place);
          expect(there >= 0).toBe(expected.has(key));
          if (kind === 'remove' && there >= 0) {
            store.remove(there);
            expected.delete(key);
          } else if (kind === 'add' && there < 0) {
            const surfel = store.add(chunk, place);
            if (surfel < 0) continue;
            store.colours[surfel] = i & 0xffff;
            expected.set(key, i & 0xffff);
          }
        }
        expect(contents(store)).toEqual(expected);
        expect(store.count).toBe(expected.size);
        expect(store.usedPages).toBeLessThanOrEqual(6);
      }),
      { numRuns: 40 },
    );
  });

  test('hands each changed page on once, in turn', () => {
    const store = new SurfelStore(4);
    store.noteChange(2);
    store.noteChange(1);
    store.noteChange(2);
    expect([store.takeChanged(), store.takeChanged(), store.takeChanged()]).toEqual([2, 1, -1]);
    store.noteChange(2);
    expect(store.changedPages).toBe(1);
    store.clear();
    expect(store.takeChanged()).toBe(-1);
  });
});
