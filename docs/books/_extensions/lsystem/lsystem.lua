-- Live drawings: code blocks of the language `lsystem` become elements <l-system>, which read the text themselves.
-- Quarto runs this as an extension, with l-system.js and embed.html of the playground beside it; Pandoc runs it by
-- --lua-filter, and the page then has to load l-system.js.

local function escaped(text)
    return (text:gsub('[&<>\n]', { ['&'] = '&amp;', ['<'] = '&lt;', ['>'] = '&gt;', ['\n'] = '&#10;' }))
end

function CodeBlock(block)
    if not block.classes:includes('lsystem') or not (FORMAT:match('html') or FORMAT:match('revealjs')) then
        return nil
    end
    if quarto then
        quarto.doc.add_html_dependency({
            name = 'l-system',
            version = '0.1.0',
            scripts = { 'l-system.js' },
            resources = { { name = 'embed.html', path = 'embed.html' } },
        })
    end
    return pandoc.RawBlock('html', '<l-system><pre>' .. escaped(block.text) .. '</pre></l-system>')
end
