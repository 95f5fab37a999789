/**
 * What tests may not do, layer by layer, so that they depend on what they test and on nothing else. They read the text:
 * what a formatter has laid out. Pure.
 */
export type TestLayer = 'deterministic' | 'stack' | 'smoke';

export interface Violation {
  rule: string;
  /** From 1. */
  line: number;
  text: string;
}

/** Files of tests whose clock is the test's own; those with processes and sockets; those with real browsers as well. */
export function layerOf(file: string): TestLayer | null {
  if (/^e2e\/pages\/.*\.ts$/.test(file) || /\.scenario\.test\.ts$/.test(file)) return 'deterministic';
  if (/\.stack\.test\.ts$/.test(file)) return 'stack';
  return /^e2e\/smoke\/.*\.ts$|\.smoke\.ts$/.test(file) ? 'smoke' : null;
}

/** Time passes because the test says so, not because somebody waits. */
const SLEEP =
  /\bsetTimeout\(\s*(?:resolve|done|r|ok|next)\b|['"](?:node:)?timers\/promises['"]|=>\s*setTimeout\(/;
/** Until something is true: that this takes long is no fault. */
const LOOPS = /\bwhile \(/;
const RETRIES = /\bretr(?:y|ies):\s*[1-9]|\.configure\(\{[^}]*retries/;
/** A test may ask what this machine has: `test.skip(!hasVideo, …)`. */
const CHOSEN = /\b(?:test|it|describe)\.(?:(?:only|fixme)\(|skip\(\s*(?:['"`)]|true\b|$))/;
/** Where somebody listens, another program may do so. An address that nobody listens at may look like a real one. */
const PORT =
  /\.listen\(\s*[1-9]|(?<!\baddress\b.*)\b(?:\w*P|p)ort: [1-9]|--[\w-]*port['"]?[,=\s]\s*['"]?[1-9]/;

/** A rule that looks at one line. */
type LineRule = [rule: string, pattern: RegExp];

const ALL: LineRule[] = [
  ['no second try of its own', RETRIES],
  ['no test is left out by hand', CHOSEN],
];
const LINE_RULES: Readonly<Record<TestLayer, readonly LineRule[]>> = {
  deterministic: [
    ...ALL,
    ['no waitForTimeout', /\bwaitForTimeout\b/],
    ['no stack', /\bLocalStack\b|smoke-test|shared-stack/],
    ['no polling', /\bexpect\.poll\b|\btoPass\(/],
    ['no real clock', /\bDate\.now\b|\bperformance\.now\b|\bprocess\.hrtime\b/],
    ['no sleep', SLEEP],
  ],
  stack: [...ALL, ['no sleep', SLEEP], ['no port number', PORT]],
  smoke: [
    ...ALL,
    ['no sleep', SLEEP],
    ['no waitForTimeout', /\bwaitForTimeout\b/],
    ['no port number', PORT],
    ['no frames as a clock', /\bexpectFrames\(\s*(?:[6-9]|\d{2,})\b/],
  ],
};

/** Comments and what texts say become spaces: lines and columns stay. */
function codeOf(source: string): string {
  const blank = (text: string) => text.replace(/[^\n]/g, ' ');
  return source.replace(/\/\*[\s\S]*?\*\//g, blank).replace(/^\s*\/\/.*$/gm, blank);
}

/** @param layer whose rules hold @param source of one file of tests */
export function violationsOf(layer: TestLayer, source: string): Violation[] {
  const lines = codeOf(source).split('\n');
  const found: Violation[] = [];
  for (const [rule, pattern] of LINE_RULES[layer])
    for (const [index, text] of lines.entries())
      if (pattern.test(text) && !(layer !== 'deterministic' && pattern === SLEEP && LOOPS.test(text)))
        found.push({ rule, line: index + 1, text: text.trim() });
  if (layer !== 'deterministic') found.push(...boundsInMs(lines));
  if (layer === 'smoke') found.push(...pictures(lines));
  found.push(...testsThatExpectNothing(lines, layer === 'deterministic'));
  return found.sort((a, b) => a.line - b.line);
}

/** An instant is no duration: what was captured before something else has its order from that. */
/** A test is over sooner than a longer bound: that asks for a unit, or for the same clock. */
const TEST_MS = 30_000;
const DURATION = /\b\w*(?<!At)Ms\b/;

/** An upper bound of a duration: of real time, it says how busy the machine is. */
function boundsInMs(lines: readonly string[]): Violation[] {
  const text = lines.join('\n');
  const bounds = /\bexpect\((?<what>[^;]*?)\)\s*\.toBeLessThan(?:OrEqual)?\((?<bound>[\d_]*)/g;
  return [...text.matchAll(bounds)]
    .filter(({ groups }) => !(Number((groups?.bound ?? '').replaceAll('_', '')) >= TEST_MS))
    .filter(({ groups }) => DURATION.test((groups?.what ?? '').split('expect(').at(-1) ?? ''))
    .map(({ index, 0: match }) => {
      // The match may begin at an earlier expectation.
      const line = text.slice(0, index + match.lastIndexOf('expect(')).split('\n').length;
      return { rule: 'no upper bound of a time', line, text: (lines[line - 1] as string).trim() };
    });
}

/** Pictures are for people, and taken only where somebody asks for them. */
function pictures(lines: readonly string[]): Violation[] {
  return lines.flatMap((text, index) => {
    const asked = lines.slice(Math.max(0, index - 3), index + 1).some((each) => /PICTURES/i.test(each));
    const takes = /\.screenshot\(|\btoHaveScreenshot\(/.test(text);
    return takes && !asked
      ? [{ rule: 'no picture that nobody asked for', line: index + 1, text: text.trim() }]
      : [];
  });
}

const TEST = /^(?<indent>\s*)(?:test|it)(?:\.each\b.*|\.for\b.*)?\(/;
const EXPECTS =
  /\btrial: true\b|\bexpect\w*\s*[.(<]|\bassert\w*[.(]|\bfail\(|\b(?:until|eventually|waitFor\w*)\(|\bwhile \(/;
/** What changes what is tested. */
const ACTS =
  /\.(?:click|dblclick|press|down|up|tap|fill|check|selectOption|dispatchEvent|tell|cut|restore|lose|hold|stick|release|goto|reload)\(/;

/** A test ends with what it has shown: an action after that is not tested. */
function testsThatExpectNothing(lines: readonly string[], acts: boolean): Violation[] {
  const helpers = helpersThatExpect(lines);
  const expects = (text: string) => EXPECTS.test(text) || (helpers?.test(text) ?? false);
  const found: Violation[] = [];
  for (const { from, until } of blocks(lines, TEST)) {
    const body = lines.slice(from, until + 1);
    const last = body.findLastIndex(expects);
    const line = from + 1;
    const text = (lines[from] as string).trim();
    if (last < 0) found.push({ rule: 'a test expects something', line, text });
    else if (acts && body.slice(last + 1).some((each) => ACTS.test(each)))
      found.push({ rule: 'a test expects something after its last action', line, text });
  }
  return found;
}

/**
 * Functions of the file in which something is expected, or waited for until the test's time is over, and what tests share
 * for that.
 */
function helpersThatExpect(lines: readonly string[]): RegExp | null {
  const FUNCTION =
    /^(?<indent>\s*)(?:export )?(?:async )?(?:function\*? (?<name>\w+)|const (?<constant>\w+) = (?:async )?\()/;
  const names = blocks(lines, FUNCTION)
    .filter(({ from, until }) =>
      lines.slice(from, until + 1).some((text) => EXPECTS.test(text) || LOOPS.test(text)),
    )
    .map(({ groups }) => groups.name ?? groups.constant);
  const shared = /^import \{(?<imported>[^}]*)\} from '[^']*(?:testing|fixtures)[^']*';/gm;
  for (const { groups } of lines.join('\n').matchAll(shared))
    names.push(
      ...(groups?.imported ?? '').split(',').flatMap((each) => /^\s*(\w+)\s*$/.exec(each)?.[1] ?? []),
    );
  return names.length === 0 ? null : new RegExp(`\\b(?:${names.join('|')})\\b`);
}

/** From a line that begins something to the line that ends it, by the indentation of both. */
function blocks(lines: readonly string[], begins: RegExp) {
  return lines.flatMap((text, from) => {
    const match = begins.exec(text);
    if (match === null) return [];
    const groups = match.groups as Record<string, string | undefined>;
    const indent = groups.indent ?? '';
    // Whatever ends on its own line.
    if (/;\s*$/.test(text)) return [{ from, until: from, groups }];
    const length = lines
      .slice(from + 1)
      .findIndex((each) => each.startsWith(`${indent})`) || each.startsWith(`${indent}}`));
    let until = length < 0 ? lines.length - 1 : from + 1 + length;
    // `])(` and `)(` of a table of cases begin the test itself.
    while (until < lines.length - 1 && !/;\s*$|^\s*\}\s*$/.test(lines[until] as string)) {
      const next = lines
        .slice(until + 1)
        .findIndex((each) => each.startsWith(`${indent})`) || each.startsWith(`${indent}}`));
      if (next < 0) break;
      until += 1 + next;
    }
    return [{ from, until, groups }];
  });
}
