import { expect, test } from 'vitest';
import { ResumeClaims } from './resume-claims.ts';

function setUp(most: number) {
  let handles = 0;
  const claims = new ResumeClaims<{ robot: string }, { operator: string }>(most, () => `c${++handles}`);
  return { claims, robot: { robot: 'r' }, ada: { operator: 'Ada' }, eve: { operator: 'Eve' } };
}

test('a claim is judged once, by its robot, for its session', () => {
  const { claims, robot, ada } = setUp(2);
  const { handle } = claims.add('s', robot, ada);
  expect(claims.take(handle, 's', { robot: 'other' })).toBeNull();
  expect(claims.take(handle, 'other', robot)).toBeNull();
  expect(claims.take(handle, 's', robot)?.operator).toBe(ada);
  expect(claims.take(handle, 's', robot)).toBeNull();
});

test('limits the claims of each operator, and keeps those of others', () => {
  const { claims, robot, ada, eve } = setUp(2);
  const adas = claims.add('s', robot, ada);
  for (let i = 0; i < 50; i++) claims.add('s', robot, eve);
  expect(claims.size).toBe(2);
  for (let i = 0; i < 50; i++) claims.add(`s${i}`, robot, eve);
  expect(claims.size).toBe(3);
  expect(claims.take(adas.handle, 's', robot)).toBe(adas);
  claims.drop(eve);
  expect(claims.size).toBe(0);
});
