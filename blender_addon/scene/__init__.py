"""What Apply leaves in the scene: images, nodes, materials and keys, and whose they are.

Knows no physics: arrays and numbers come in, data-blocks of Blender are made or changed.
"""
