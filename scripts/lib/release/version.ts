/** Versions of releases: Semantic Versioning without pre-releases. Pure. */
import type { ChangeKind } from './changelog.ts';

export type Version = readonly [major: number, minor: number, patch: number];

/** Parts of a version, by how much their step says. */
export const STEPS = ['patch', 'minor', 'major'] as const;
export type Step = (typeof STEPS)[number];

/** `null` where the text is no version. */
export function parseVersion(text: string): Version | null {
  const match = /^(0|[1-9]\d*)\.(0|[1-9]\d*)\.(0|[1-9]\d*)$/.exec(text);
  if (match === null) return null;
  const [, major, minor, patch] = match.map(Number);
  return [major!, minor!, patch!];
}

export function formatVersion(version: Version): string {
  return version.join('.');
}

/** Negative where `a` comes before `b`, 0 where they are the same. */
export function compareVersions(a: Version, b: Version): number {
  return a[0] - b[0] || a[1] - b[1] || a[2] - b[2];
}

export function nextVersion([major, minor, patch]: Version, step: Step): Version {
  if (step === 'major') return [major + 1, 0, 0];
  if (step === 'minor') return [major, minor + 1, 0];
  return [major, minor, patch + 1];
}

const BREAKING: readonly ChangeKind[] = ['Breaking changes', 'Removed'];
const NEW: readonly ChangeKind[] = ['Added', 'Changed', 'Deprecated'];

/** The least step that changes of these kinds ask for. Before 1.0 a breaking change asks for a minor one. */
export function leastStep(kinds: readonly ChangeKind[], present: Version): Step {
  if (kinds.some((kind) => BREAKING.includes(kind))) return present[0] === 0 ? 'minor' : 'major';
  return kinds.some((kind) => NEW.includes(kind)) ? 'minor' : 'patch';
}
