"""What Apply leaves in the scene: images, nodes, materials and keys, and who owns them.

Knows no physics: it takes arrays and numbers, and makes or changes data-blocks of Blender.
"""
