import {
  encodeTicket,
  exportOperatorKey,
  type GrantClaims,
  keyThumbprint,
  makeOperatorKey,
} from '@farpoint/grants';
import { grantTo, makeIssuer } from '@farpoint/grants/testing';
import { beforeEach, describe, expect, it } from 'vitest';
import { MOST_GRANTS, OperatorAccess, type ReadResult } from './operator-access.ts';
import { type AccessStorage, NO_ACCESS, type StoredAccess } from './stored-access.ts';

const NOW = 1_800_000_000;
const issuer = await makeIssuer();

class Memory implements AccessStorage {
  access: StoredAccess = NO_ACCESS;
  keeps = true;
  load = async () => this.access;
  save = async (access: StoredAccess) => {
    if (this.keeps) this.access = access;
    return this.keeps;
  };
}

let memory: Memory;
let access: OperatorAccess;
beforeEach(() => {
  memory = new Memory();
  access = new OperatorAccess(memory, () => NOW);
});

/** A grant for this browser's key. */
async function granted(change: Partial<GrantClaims> = {}): Promise<string> {
  await access.makeKey();
  const jkt = access.ownKey.value ?? '';
  return (await grantTo(issuer, NOW, { cnf: { jkt }, ...change })).grant;
}

async function add(text: string) {
  const read = await access.read(text);
  if ('fault' in read) throw new Error(read.fault);
  return await access.add(read);
}

const fault = (read: ReadResult) => ('fault' in read ? read.fault : null);

describe('the operator’s access', () => {
  it('has one key of its own that no script can read, made on demand and kept', async () => {
    expect(access.ownKey.value).toBeNull();
    await access.makeKey();
    const own = memory.access.own;
    expect(own?.privateKey.extractable).toBe(false);
    await access.makeKey();
    expect(memory.access.own).toBe(own);
    const later = new OperatorAccess(memory, () => NOW);
    await later.credentials();
    expect(later.ownKey.value).toBe(own === null ? '' : await keyThumbprint(own.publicJwk));
  });

  it('takes a grant for its own key, shows it, and finds it at the next visit', async () => {
    expect(await add(`  ${await granted()}\n`)).toBe(true);
    expect(access.grants.value).toMatchObject([{ id: 'g1', claims: { name: 'Ada Lovelace' } }]);
    const later = new OperatorAccess(memory, () => NOW);
    expect(await later.credentials()).toHaveLength(1);
    await later.remove('g1');
    expect([later.grants.value, memory.access.grants]).toEqual([[], []]);
    expect(memory.access.own).not.toBeNull();
  });

  it('takes a ticket, whose key no script can read any more', async () => {
    const { grant, key } = await grantTo(issuer, NOW);
    expect(await add(encodeTicket({ grant, key: await exportOperatorKey(key) }))).toBe(true);
    const [held] = await access.credentials();
    expect(held?.key.privateKey.extractable).toBe(false);
    expect(await keyThumbprint(held?.key.publicJwk ?? key.publicJwk)).toBe(
      await keyThumbprint(key.publicJwk),
    );
  });

  it('says why a text is no use', async () => {
    const { grant } = await grantTo(issuer, NOW);
    const other = await makeOperatorKey(true);
    const ticket = encodeTicket({ grant, key: await exportOperatorKey(other) });
    expect(fault(await access.read('hello'))).toBe('no-grant');
    expect(fault(await access.read(grant))).toBe('other-key');
    expect(fault(await access.read(ticket))).toBe('bad-ticket');
    expect(fault(await access.read(ticket.slice(0, 40)))).toBe('bad-ticket');
    expect(fault(await access.read(await granted({ exp: NOW })))).toBe('expired');
  });

  it('replaces a grant that it has, and keeps no more than it can show', async () => {
    const grant = await granted();
    await add(grant);
    await add(grant);
    expect(access.grants.value).toHaveLength(1);
    for (let i = 1; i < MOST_GRANTS; i++) await add(await granted({ jti: `more-${i}` }));
    expect(await add(await granted({ jti: 'one-too-many' }))).toBe('too-many');
    expect(access.grants.value).toHaveLength(MOST_GRANTS);
  });

  it('forgets a person’s grants that have ended when a new one comes, and no others', async () => {
    let nowS = NOW;
    access = new OperatorAccess(memory, () => nowS);
    await add(await granted({ jti: 'old', exp: NOW + 10 }));
    await add(await granted({ jti: 'other-issuer', iss: 'else', exp: NOW + 10 }));
    await add(await granted({ jti: 'other-person', sub: 'grace', exp: NOW + 10 }));
    await add(await granted({ jti: 'running' }));
    nowS = NOW + 10;
    await add(await granted({ jti: 'new' }));
    expect(access.grants.value.map(({ id }) => id)).toEqual([
      ...['other-issuer', 'other-person', 'running', 'new'],
    ]);
  });

  it('takes a grant that it asked for, before robots are shown anything, and nothing else', async () => {
    const grant = await granted();
    const taking = access.takeAsked(grant);
    expect(await access.credentials()).toHaveLength(1);
    expect(await taking).toMatchObject({ claims: { name: 'Ada Lovelace' } });
    const { grant: others, key } = await grantTo(issuer, NOW);
    const ticket = encodeTicket({ grant: others, key: await exportOperatorKey(key) });
    expect(await access.takeAsked(others)).toEqual({ fault: 'other-key' });
    expect(await access.takeAsked(ticket)).toEqual({ fault: 'other-key' });
    expect(await access.takeAsked('rubbish')).toEqual({ fault: 'no-grant' });
    expect(access.grants.value).toHaveLength(1);
  });

  it('says that nothing is kept where the browser stores nothing', async () => {
    const grant = await granted();
    memory.keeps = false;
    expect(await add(grant)).toBe(false);
    expect(await access.credentials()).toHaveLength(1);
  });

  it('shows no grant that cannot be read any more', async () => {
    const key = await makeOperatorKey();
    memory.access = { own: key, grants: [{ grant: 'rubbish', key }] };
    const later = new OperatorAccess(memory, () => NOW);
    await later.credentials();
    expect(later.grants.value).toEqual([]);
  });
});
