/** Makes visible what the Markdown theme leaves out: the docstrings of a union's members, and the class that is thrown. */
import {
  type Application,
  type Comment,
  Converter,
  type DeclarationReflection,
  LiteralType,
  ReflectionKind,
  UnionType,
} from 'typedoc';

/** To be called before the conversion. */
export function showDetails(app: Application): void {
  app.converter.on(Converter.EVENT_RESOLVE_END, ({ project }) => {
    for (const reflection of Object.values(project.reflections)) {
      if (reflection.comment !== undefined) nameThrown(reflection.comment);
    }
    for (const alias of project.getReflectionsByKind(ReflectionKind.TypeAlias)) {
      listMembers(alias as DeclarationReflection);
    }
  });
}

/** `@throws {Class} text`: TypeDoc keeps the class apart from the text, and the theme prints the text alone. */
function nameThrown(comment: Comment): void {
  for (const tag of comment.blockTags) {
    const thrown = tag.typeAnnotation?.replace(/^\{|\}$/g, '');
    if (tag.tag !== '@throws' || thrown === undefined) continue;
    tag.content.unshift({ kind: 'code', text: `\`${thrown}\`` }, { kind: 'text', text: ' ' });
  }
}

/** Ends the alias's description with a list of the members of its union, where they have docstrings. */
function listMembers({ type, comment }: DeclarationReflection): void {
  if (!(type instanceof UnionType) || type.elementSummaries === undefined || comment === undefined) return;
  const members = type.types.flatMap((member, index) => {
    const summary = type.elementSummaries?.[index] ?? [];
    return member instanceof LiteralType && summary.length > 0 ? [{ value: member.value, summary }] : [];
  });
  members.forEach(({ value, summary }, index) => {
    const text = `${index === 0 ? '\n\n' : '\n'}- \`${JSON.stringify(value)}\`: `;
    comment.summary.push({ kind: 'text', text }, ...summary);
  });
}
